#include "calibration/fitter_pool.h"

#include <atomic>
#include <utility>

#include "base/thread_pool.h"

namespace fusee::calibration {

FitterPool::FitterPool(const Evidence& evidence, std::stop_token stop) : evidence_(evidence), stop_(std::move(stop)) {
  for (unsigned i = 0; i < ThreadPool::shared().threads(); ++i)
    forwards_.emplace_back(*evidence.declared, evidence.log, evidence.earlier);
}

void FitterPool::each(std::size_t count, const std::function<void(const Fitter&, std::size_t)>& job,
                      const std::function<void(std::size_t)>& done) {
  std::atomic<std::size_t> ended = 0;
  const auto fit = [&](std::size_t index, std::size_t slot) {
    job(Fitter(evidence_, forwards_[slot]), index);
    ++ended;
    if (done && slot == 0) done(ended);
  };
  ThreadPool::shared().each(count, fit, 0, stop_);
}

}  // namespace fusee::calibration
