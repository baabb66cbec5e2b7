/// \file
/// Internal: the thread pool of the process, for single tasks and for loops. Every job writes only to its own data, so
/// results do not depend on the number of threads. Jobs may start and await other jobs.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace fusee {

class ThreadPool;

/// Work that is done at most once: by a thread of the pool, or by the thread that awaits it, whichever comes first. A
/// wait therefore lasts only for work that has begun, and nested waits cannot deadlock.
class Job {
 public:
  Job(ThreadPool& pool, std::function<void()> work) : pool_(pool), work_(std::move(work)) {}

  /// Does the work, unless it has begun.
  void run();
  /// Returns when the work is done. Rethrows its exception.
  void await();
  /// Drops the work, or waits for its end if it has begun.
  void discard();

 private:
  enum class State { waiting, running, ended };
  bool begin();
  void wait_for_end();

  ThreadPool& pool_;
  std::function<void()> work_;
  std::mutex guard_;
  std::condition_variable at_end_;
  State state_ = State::waiting;
  std::exception_ptr failure_;
};

/// The result of a job, which may not have ended yet. The destructor drops work that has not begun and waits for the end
/// of work that has, so that the work may refer to local variables.
template <typename Value>
class Task {
 public:
  /// No work; valid() is false.
  Task() = default;
  template <typename Work>
  Task(ThreadPool& pool, Work work) : result_(std::make_unique<Result>()) {
    job_ = std::make_shared<Job>(pool, [result = result_.get(), work = std::move(work)]() mutable {
      if constexpr (std::is_void_v<Value>)
        work();
      else
        result->emplace(work());
    });
  }
  Task(Task&&) noexcept = default;
  Task& operator=(Task&& other) noexcept {
    if (this != &other) discard();
    job_ = std::move(other.job_);
    result_ = std::move(other.result_);
    return *this;
  }
  ~Task() { discard(); }

  bool valid() const { return job_ != nullptr; }
  const std::shared_ptr<Job>& job() const { return job_; }

  /// Waits for the value and moves it out; once only. Rethrows the exception of the work.
  Value get() {
    job_->await();
    if constexpr (!std::is_void_v<Value>) return std::move(**result_);
  }
  /// Waits for the value and keeps it: for several readers, from any thread. Rethrows the exception of the work.
  const auto& value() const {
    job_->await();
    return **result_;
  }

 private:
  using Result = std::optional<std::conditional_t<std::is_void_v<Value>, std::monostate, Value>>;

  void discard() {
    if (job_) job_->discard();
  }

  std::unique_ptr<Result> result_;
  std::shared_ptr<Job> job_;
};

/// At most `threads` threads work at once, the caller's included. A thread that waits does not count: another one takes
/// its place.
class ThreadPool {
 public:
  /// The pool of the process. It starts its threads when they are first needed, and never ends. A forked process has a
  /// pool of its own.
  static ThreadPool& shared();
  /// Number of threads that the process may run at once, 1 … 8.
  static unsigned available_threads();

  /// At least one thread: that of the caller.
  explicit ThreadPool(unsigned threads) : limit_(threads > 1 ? static_cast<int>(threads) - 1 : 0) {}
  /// Ends the threads. No job may be left.
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  unsigned threads() const { return static_cast<unsigned>(limit_ + 1); }

  /// Starts `work` as soon as a thread is free. Without `in_background`, the thread that requests the value does the
  /// work.
  template <typename Work>
  auto run_async(Work work, bool in_background = true) {
    Task<std::invoke_result_t<Work&>> task(*this, std::move(work));
    if (in_background) enqueue(task.job());
    return task;
  }

  /// Receives an index and the number of a slot, 0 … threads() − 1. Jobs that run at once have different slots; the
  /// calling thread has slot 0.
  using LoopJob = std::function<void(std::size_t index, std::size_t slot)>;

  /// Calls `job` for 0 … count − 1 in parallel and returns when all have ended. `most_threads` limits the threads; 0:
  /// no limit beyond that of the pool. After an exception no further job begins, and the exception of the lowest index
  /// is rethrown. After a request to stop no further job begins, and Stopped is thrown if jobs remain.
  void each(std::size_t count, const LoopJob& job, unsigned most_threads = 0, const std::stop_token& stop = {});

  /// While an object lives, its thread waits for the disk or for another thread, and does not count as working.
  class WaitingScope {
   public:
    explicit WaitingScope(ThreadPool& pool) : pool_(pool) { pool_.count_working(-1); }
    ~WaitingScope() { pool_.count_working(1); }
    WaitingScope(const WaitingScope&) = delete;
    WaitingScope& operator=(const WaitingScope&) = delete;

   private:
    ThreadPool& pool_;
  };

 private:
  void enqueue(std::shared_ptr<Job> job);
  void count_working(int change);
  void grant_jobs();
  bool start_thread();
  void work();

  const int limit_;  ///< number of jobs that may run in addition to the caller
  std::mutex guard_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Job>> queue_;
  std::vector<std::thread> threads_;
  std::size_t idle_ = 0;     ///< threads without a job
  std::size_t granted_ = 0;  ///< jobs of the queue that idle threads have been woken for
  int working_ = 0;          ///< threads with a job or woken for one, without those that wait
  bool closed_ = false;
};

/// ThreadPool::run_async() of the shared pool.
template <typename Work>
auto run_async(Work work, bool in_background = true) {
  return ThreadPool::shared().run_async(std::move(work), in_background);
}

}  // namespace fusee
