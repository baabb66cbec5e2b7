/// \file
/// The same simulation many times over, on as many threads as the machine has. The outcome does not depend on how many.
#pragma once

#include <functional>
#include <vector>

#include "calibration/fit.h"

namespace fusee {

class Workers {
 public:
  /// `evidence` must outlive this.
  explicit Workers(const Evidence& evidence);

  /// Calls `job` for 0 … count − 1, each with a simulation of its own thread. The first exception is passed on.
  /// `done(n)` is called from this thread whenever n of the jobs were seen to have ended; it may throw.
  void each(std::size_t count, const std::function<void(const Fitter&, std::size_t)>& job,
            const std::function<void(std::size_t)>& done = {});
  /// For a single fit in between.
  Fitter one() { return Fitter(evidence_, forwards_.front()); }

 private:
  const Evidence& evidence_;
  std::vector<Forward> forwards_;
};

}  // namespace fusee
