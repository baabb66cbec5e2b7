/// \file
/// The part of a run that its caller controls: progress, stop, and access to files.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string_view>

#include "fusee/base/file_access.h"

namespace fusee {

/// Thrown by a verb that was asked to stop. No file was published.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("interrupted") {}
};

/// Last argument of every verb. The default reports nothing, never stops, and uses the disk.
struct RunContext {
  /// Called at the start of each step with its name and, if known, the share of the work that is done, 0 … 1. Called
  /// only by the thread that called the verb. An exception from it ends the verb and leaves no files.
  using Progress = std::function<void(std::string_view step, std::optional<double> share)>;

  Progress progress = {};
  /// After a request every OutputFolder removes its staged files at once, and the verb throws Stopped at its next step.
  std::stop_token stop = {};
  FileAccess* files = &disk();  ///< inputs are read through it and outputs reported to it; never null

  /// Reports a step. Throws Stopped.
  void begin_step(std::string_view step, std::optional<double> share = std::nullopt) const {
    throw_if_stopped();
    if (progress) progress(step, share);
  }
  void throw_if_stopped() const {
    if (stop.stop_requested()) throw Stopped();
  }
  /// For trials and for other threads.
  RunContext without_progress() const { return {{}, stop, files}; }
};

}  // namespace fusee
