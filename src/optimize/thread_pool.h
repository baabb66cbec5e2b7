/// \file
/// Internal: a thread pool. Every job writes only to its own place, so that the result does not depend on the number of
/// threads.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace fusee::optimize {

class ThreadPool {
 public:
  /// 0: as many threads as the machine has.
  explicit ThreadPool(unsigned threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Calls `job` for 0 … count − 1 and returns when all are done. Rethrows the first exception.
  void each(std::size_t count, const std::function<void(std::size_t)>& job);

 private:
  void wait_for_work();
  void take_jobs();

  std::mutex guard_;
  std::condition_variable begun_, ended_;
  const std::function<void(std::size_t)>* job_ = nullptr;
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  std::size_t busy_ = 0;
  unsigned long round_ = 0;
  bool closed_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> threads_;
};

}  // namespace fusee::optimize
