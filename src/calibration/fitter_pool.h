/// \file
/// Fits in parallel. The result does not depend on the number of threads.
#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "calibration/fit.h"

namespace fusee::calibration {

class FitterPool {
 public:
  /// `evidence` must outlive this.
  explicit FitterPool(const Evidence& evidence, std::stop_token stop = {});

  /// Calls `job` for 0 … count − 1, with one simulation for each thread. Rethrows the exception of the lowest index.
  /// Throws Stopped after a request to stop. `done(n)` is called from the calling thread when n jobs have ended;
  /// it may throw.
  void each(std::size_t count, const std::function<void(const Fitter&, std::size_t)>& job,
            const std::function<void(std::size_t)>& done = {});
  /// Fitter for a single fit between jobs.
  Fitter one() { return Fitter(evidence_, forwards_.front()); }

 private:
  const Evidence& evidence_;
  std::stop_token stop_;
  std::vector<joint::Forward> forwards_;
};

}  // namespace fusee::calibration
