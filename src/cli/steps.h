/// \file
/// Progress and signals while a command runs the pipeline.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "cli/console.h"
#include "cli/interrupt.h"

namespace fusee::cli {

class Steps {
 public:
  explicit Steps(Console& console) : console_(console) {}

  /// Shows each step, and throws Interrupted after a signal.
  std::function<void(std::string_view step)> shown() {
    return [this](std::string_view step) {
      stop_if_interrupted();
      console_.progress(step);
    };
  }
  /// Before the first file is written a signal exits at once; from then on it is recorded.
  std::function<void()> before_writing() {
    return [this] {
      if (!writing_) writing_.emplace();
      stop_if_interrupted();
    };
  }
  /// To be called when all files are in place.
  void end_writing() { writing_.reset(); }

 private:
  Console& console_;
  std::optional<InterruptsDeferred> writing_;
};

}  // namespace fusee::cli
