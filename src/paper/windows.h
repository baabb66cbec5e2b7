/// \file
/// Internal: over which stretches of a number does something hold?
#pragma once

#include <functional>
#include <vector>

#include "fusee/paper/reproduction.h"

namespace fusee {

/// Looks at `steps` + 1 evenly spaced values and halves its way to every border between two that differ. A stretch
/// narrower than a step is missed.
std::vector<Window> windows_where(const std::function<bool(double)>& holds, double low, double high, int steps);

/// "0.132 to 0.249", "up to 0.21", "nowhere".
std::string windows_text(const WindowsOf& windows);

}  // namespace fusee
