#include "optimize/thread_pool.h"

#include <algorithm>

namespace fusee::optimize {
namespace {

constexpr unsigned k_max_threads = 8;

}  // namespace

ThreadPool::ThreadPool(unsigned threads) {
  const unsigned wanted = threads > 0 ? threads : std::thread::hardware_concurrency();
  for (unsigned i = 1; i < std::clamp(wanted, 1u, k_max_threads); ++i)
    threads_.emplace_back([this] { wait_for_work(); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard<std::mutex> lock(guard_);
    closed_ = true;
  }
  begun_.notify_all();
  for (std::thread& other : threads_) other.join();
}

void ThreadPool::each(std::size_t count, const std::function<void(std::size_t)>& job) {
  {
    const std::lock_guard<std::mutex> lock(guard_);
    job_ = &job;
    count_ = count;
    next_ = 0;
    failure_ = nullptr;
    ++round_;
  }
  if (count > 1) begun_.notify_all();
  take_jobs();
  std::unique_lock<std::mutex> lock(guard_);
  ended_.wait(lock, [this] { return busy_ == 0; });
  if (failure_) std::rethrow_exception(failure_);
}

void ThreadPool::wait_for_work() {
  unsigned long seen = 0;
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(guard_);
      begun_.wait(lock, [&] { return closed_ || round_ != seen; });
      if (closed_) return;
      seen = round_;
    }
    take_jobs();
  }
}

void ThreadPool::take_jobs() {
  std::unique_lock<std::mutex> lock(guard_);
  ++busy_;
  while (next_ < count_) {
    const std::size_t mine = next_++;
    const auto& job = *job_;
    lock.unlock();
    try {
      job(mine);
      lock.lock();
    } catch (...) {
      lock.lock();
      if (!failure_) failure_ = std::current_exception();
      next_ = count_;
    }
  }
  if (--busy_ == 0) ended_.notify_all();
}

}  // namespace fusee::optimize
