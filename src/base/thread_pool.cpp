#include "base/thread_pool.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <system_error>

#include "fusee/base.h"

namespace fusee {
namespace {

constexpr unsigned k_max_threads = 8;
/// Upper bound on the threads that a pool starts, including those that replace waiting ones. Beyond it, a job begins
/// when a thread is free or when the job is awaited.
constexpr std::size_t k_max_started = 64;

std::atomic<ThreadPool*> shared_pool = nullptr;

/// The threads of the parent do not exist in a forked process, and its locks may be held. The old pool is abandoned.
void renew_shared_pool() { shared_pool = new ThreadPool(ThreadPool::available_threads()); }

/// A loop that several threads work on.
class Loop {
 public:
  Loop(std::size_t count, const ThreadPool::LoopJob& job, const std::stop_token& stop)
      : count_(count), job_(job), stop_(stop) {}

  void run(std::size_t slot) {
    while (!stop_.stop_requested()) {
      const std::size_t index = next_++;
      if (index >= count_) return;
      try {
        job_(index, slot);
      } catch (...) {
        fail(index);
      }
    }
  }
  /// Called when no thread runs the loop any longer.
  void demand_success() const {
    if (failure_) std::rethrow_exception(failure_);
    if (next_ < count_) throw Stopped();
  }

 private:
  /// Lower indices have begun already, so the lowest failure does not depend on the threads.
  void fail(std::size_t index) {
    const std::lock_guard<std::mutex> lock(guard_);
    next_ = count_;
    if (failure_ && failed_ < index) return;
    failed_ = index;
    failure_ = std::current_exception();
  }

  const std::size_t count_;
  const ThreadPool::LoopJob& job_;
  const std::stop_token& stop_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex guard_;
  std::size_t failed_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

// ---- jobs -----------------------------------------------------------------------------------------------------------

bool Job::begin() {
  const std::lock_guard<std::mutex> lock(guard_);
  if (state_ != State::waiting) return false;
  state_ = State::running;
  return true;
}

void Job::run() {
  if (!begin()) return;
  std::exception_ptr failure;
  try {
    work_();
  } catch (...) {
    failure = std::current_exception();
  }
  work_ = nullptr;
  const std::lock_guard<std::mutex> lock(guard_);
  failure_ = std::move(failure);
  state_ = State::ended;
  at_end_.notify_all();
}

void Job::wait_for_end() {
  std::unique_lock<std::mutex> lock(guard_);
  if (state_ == State::ended) return;
  const ThreadPool::WaitingScope waiting(pool_);
  at_end_.wait(lock, [this] { return state_ == State::ended; });
}

void Job::await() {
  run();
  wait_for_end();
  if (failure_) std::rethrow_exception(failure_);
}

void Job::discard() {
  if (!begin()) return wait_for_end();
  work_ = nullptr;
  const std::lock_guard<std::mutex> lock(guard_);
  state_ = State::ended;
  at_end_.notify_all();
}

// ---- pool -----------------------------------------------------------------------------------------------------------

unsigned ThreadPool::available_threads() { return std::clamp(std::thread::hardware_concurrency(), 1u, k_max_threads); }

ThreadPool& ThreadPool::shared() {
  [[maybe_unused]] static const bool is_made = [] {
    renew_shared_pool();
    return ::pthread_atfork(nullptr, nullptr, renew_shared_pool) == 0;
  }();
  return *shared_pool;
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard<std::mutex> lock(guard_);
    closed_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::each(std::size_t count, const LoopJob& job, unsigned most_threads, const std::stop_token& stop) {
  const unsigned allowed = most_threads > 0 ? std::min(most_threads, threads()) : threads();
  Loop loop(count, job, stop);
  {
    std::vector<Task<void>> others;
    for (std::size_t slot = 1; slot < std::min<std::size_t>(allowed, count); ++slot)
      others.push_back(run_async([&loop, slot] { loop.run(slot); }));
    loop.run(0);
  }
  loop.demand_success();
}

void ThreadPool::enqueue(std::shared_ptr<Job> job) {
  if (limit_ == 0) return;
  const std::lock_guard<std::mutex> lock(guard_);
  queue_.push_back(std::move(job));
  grant_jobs();
  if (threads_.empty()) queue_.clear();  // the system has no thread left: whoever awaits the job runs it
}

void ThreadPool::count_working(int change) {
  const std::lock_guard<std::mutex> lock(guard_);
  working_ += change;
  grant_jobs();
}

/// Wakes as many threads as may work on queued jobs. Called with the lock.
void ThreadPool::grant_jobs() {
  while (working_ < limit_ && granted_ < queue_.size()) {
    const bool all_idle_are_woken = idle_ == granted_;
    if (all_idle_are_woken && !start_thread()) return;
    ++working_;
    ++granted_;
    changed_.notify_one();
  }
}

bool ThreadPool::start_thread() {
  if (threads_.size() >= k_max_started) return false;
  try {
    threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    return false;
  }
  ++idle_;
  return true;
}

void ThreadPool::work() {
  std::unique_lock<std::mutex> lock(guard_);
  for (;;) {
    changed_.wait(lock, [this] { return closed_ || granted_ > 0; });
    if (closed_) return;
    --granted_;
    --idle_;
    std::shared_ptr<Job> job = std::move(queue_.front());
    queue_.pop_front();
    lock.unlock();
    job->run();
    job.reset();
    lock.lock();
    ++idle_;
    --working_;
    grant_jobs();
  }
}

}  // namespace fusee
