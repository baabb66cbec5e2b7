/// \file
/// Internal: asynchronous calls.
#pragma once

#include <future>
#include <system_error>
#include <utility>

namespace fusee {

/// Runs `work` on a thread of its own and returns its future. Without `worth`, or when the system has no thread left,
/// `work` runs when the value is requested. Exceptions are rethrown with the value.
template <typename Work>
auto run_async(Work work, bool worth = true) {
  if (worth) {
    try {
      return std::async(std::launch::async, work);
    } catch (const std::system_error&) {
      // No thread available: the call is deferred, which only costs time.
    }
  }
  return std::async(std::launch::deferred, std::move(work));
}

}  // namespace fusee
