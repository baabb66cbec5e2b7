/// \file
/// Fits on as many threads as the machine has. The result does not depend on their number.
#pragma once

#include <functional>
#include <vector>

#include "calibration/fit.h"

namespace fusee::calibration {

class FitterPool {
 public:
  /// `evidence` must outlive this.
  explicit FitterPool(const Evidence& evidence);

  /// Calls `job` for 0 … count − 1, with one simulation for each thread. The first exception is rethrown. `done(n)` is
  /// called from the calling thread when n jobs have ended; it may throw.
  void each(std::size_t count, const std::function<void(const Fitter&, std::size_t)>& job,
            const std::function<void(std::size_t)>& done = {});
  /// Fitter for a single fit between jobs.
  Fitter one() { return Fitter(evidence_, forwards_.front()); }

 private:
  const Evidence& evidence_;
  std::vector<joint::Forward> forwards_;
};

}  // namespace fusee::calibration
