/// \file
/// Ctrl-C, SIGTERM and SIGHUP: exit 130, nothing half done.
#pragma once

#include <stdexcept>

namespace fusee::cli {

class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// From here on a signal ends the program at once with exit 130, but for the places below.
void catch_interrupts();

/// While one of these lives something stands on the disk that has to be removed: a signal is only noted, and
/// stop_if_interrupted() throws Interrupted at the next step. What it ends with otherwise stands: a signal that comes
/// when the files are in place would only say that they are not.
class InterruptsDeferred {
 public:
  InterruptsDeferred();
  ~InterruptsDeferred();
  InterruptsDeferred(const InterruptsDeferred&) = delete;
  InterruptsDeferred& operator=(const InterruptsDeferred&) = delete;
};
void stop_if_interrupted();
/// Exit 130 at once, whatever other threads do.
[[noreturn]] void leave_interrupted();
/// For a search that has an answer whenever it is stopped.
bool is_interrupted();

}  // namespace fusee::cli
