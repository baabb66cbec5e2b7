/// \file
/// Internal: progress of a search.
#pragma once

#include <optional>
#include <string>

#include "base/text.h"
#include "fusee/base.h"

namespace fusee::optimize {

/// Reports the best value so far and an estimate of the share that is done, 0 … 1. False if the search must stop.
inline bool may_continue(const RunContext& context, double done, std::optional<double> best) {
  if (context.progress) context.progress(best ? "best " + rounded(*best, 6) : std::string(), done);
  return !context.stop.stop_requested();
}

}  // namespace fusee::optimize
