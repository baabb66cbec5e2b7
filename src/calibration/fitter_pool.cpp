#include "calibration/fitter_pool.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace fusee::calibration {
namespace {

constexpr unsigned k_most_threads = 8;

}  // namespace

FitterPool::FitterPool(const Evidence& evidence) : evidence_(evidence) {
  const unsigned threads = std::clamp(std::thread::hardware_concurrency(), 1u, k_most_threads);
  for (unsigned i = 0; i < threads; ++i) forwards_.emplace_back(*evidence.declared, evidence.log, evidence.earlier);
}

void FitterPool::each(std::size_t count, const std::function<void(const Fitter&, std::size_t)>& job,
                      const std::function<void(std::size_t)>& done) {
  std::atomic<std::size_t> next{0};
  std::mutex guard;
  std::exception_ptr failure;
  const auto fail = [&] {
    const std::lock_guard<std::mutex> lock(guard);
    if (!failure) failure = std::current_exception();
    next = count;
  };
  const auto work = [&](joint::Forward& forward) {
    try {
      const Fitter fitter(evidence_, forward);
      for (std::size_t i = next++; i < count; i = next++) job(fitter, i);
    } catch (...) {
      fail();
    }
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < std::min(forwards_.size(), count); ++i) others.emplace_back(work, std::ref(forwards_[i]));
  try {
    const Fitter fitter = one();
    for (std::size_t i = next++; i < count; i = next++) {
      job(fitter, i);
      if (done) done(std::min<std::size_t>(next, count));
    }
  } catch (...) {
    fail();
  }
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace fusee::calibration
