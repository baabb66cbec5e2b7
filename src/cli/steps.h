/// \file
/// What a command says, and how it hears a signal, while the pipeline works for it.
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

  /// Shows each step, and goes no further where a signal came.
  std::function<void(std::string_view step)> shown() {
    return [this](std::string_view step) {
      stop_if_interrupted();
      console_.progress(step);
    };
  }
  /// Until something stands on the disk a signal ends the program where it is; from then on it is noted.
  std::function<void()> before_writing() {
    return [this] {
      if (!writing_) writing_.emplace();
      stop_if_interrupted();
    };
  }
  /// The files are in place.
  void end_writing() { writing_.reset(); }

 private:
  Console& console_;
  std::optional<InterruptsDeferred> writing_;
};

}  // namespace fusee::cli
