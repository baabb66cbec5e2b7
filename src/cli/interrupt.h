/// \file
/// Ctrl-C, SIGTERM and SIGHUP: exit 130 without partial output.
#pragma once

#include <stdexcept>

namespace fusee::cli {

class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// From now on a signal exits with 130 at once, except while InterruptsDeferred exists.
void catch_interrupts();

/// While an instance exists, files on the disk need cleaning up: a signal is only recorded, and stop_if_interrupted()
/// throws Interrupted at the next step. A signal after the last step has no effect, because all files are in place.
class InterruptsDeferred {
 public:
  InterruptsDeferred();
  ~InterruptsDeferred();
  InterruptsDeferred(const InterruptsDeferred&) = delete;
  InterruptsDeferred& operator=(const InterruptsDeferred&) = delete;
};
void stop_if_interrupted();
/// Exits with 130 at once, independent of other threads.
[[noreturn]] void leave_interrupted();
/// True after a signal, for searches that have a result whenever they stop.
bool is_interrupted();

}  // namespace fusee::cli
