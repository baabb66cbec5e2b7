/// \file
/// Internal: the same work on as many threads as there are. Every job writes to its own place only, so that the outcome
/// does not depend on how many.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace fusee {

class Hands {
 public:
  /// 0: as many as the machine has.
  explicit Hands(unsigned threads);
  ~Hands();
  Hands(const Hands&) = delete;
  Hands& operator=(const Hands&) = delete;

  /// Calls `job` for 0 … count − 1 and returns when all are done. The first exception is passed on.
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
  std::vector<std::thread> others_;
};

}  // namespace fusee
