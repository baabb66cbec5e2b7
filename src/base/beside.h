/// \file
/// Work beside other work, on threads.
#pragma once

#include <future>
#include <system_error>
#include <utility>

namespace fusee {

/// Begins `work` on a thread of its own; where it is not `worth` one, or the system has none to give, it is done when
/// its value is asked for. What it throws comes with the value.
template <typename Work>
auto beside(Work work, bool worth = true) {
  if (worth) {
    try {
      return std::async(std::launch::async, work);
    } catch (const std::system_error&) {
      // Too many threads, or no memory for a stack: it only takes longer.
    }
  }
  return std::async(std::launch::deferred, std::move(work));
}

}  // namespace fusee
