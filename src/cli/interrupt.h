/// \file
/// Ctrl-C, SIGTERM and SIGHUP: exit 130 without partial output.
#pragma once

#include <stop_token>
#include <thread>

namespace fusee::cli {

/// Handles signals while it lives. A signal requests a stop, which makes every OutputFolder remove its staged files.
/// Then the program exits with 130 at once, even if other threads run. A program has only one.
class SignalWatch {
 public:
  SignalWatch();
  /// Exits if a signal came and the exit is not prevented.
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  std::stop_token stop() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::thread thread_;
};

/// From now on a signal does not exit. For when all files are in place, or for a command that gives a result even if it
/// is stopped.
void prevent_exit_by_signal();
/// True after a signal.
bool is_interrupted();

}  // namespace fusee::cli
