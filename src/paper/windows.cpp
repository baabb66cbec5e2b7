#include "paper/windows.h"

#include "base/text.h"

namespace fusee::paper {
namespace {

/// The last value at which `holds` is true, between `good` (true) and `bad` (false), to 1/4096 of their distance.
double border(const std::function<bool(double)>& holds, double good, double bad) {
  constexpr int k_halvings = 12;
  for (int i = 0; i < k_halvings; ++i) {
    const double middle = 0.5 * (good + bad);
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace

std::vector<Window> windows_where(const std::function<bool(double)>& holds, double low, double high, int steps) {
  std::vector<Window> windows;
  bool held_before = false;
  double last = low;
  for (int i = 0; i <= steps; ++i) {
    const double value = low + (high - low) * i / steps;
    const bool holds_here = holds(value);
    if (holds_here && !held_before)
      windows.push_back({i == 0 ? low : border(holds, value, last), value, i == 0, false});
    if (!holds_here && held_before) windows.back().high = border(holds, last, value);
    if (holds_here && i == steps) {
      windows.back().high = high;
      windows.back().open_high = true;
    }
    held_before = holds_here;
    last = value;
  }
  return windows;
}

std::string searched_text(const ParameterWindows& parameter) {
  return rounded(parameter.searched_low, 3) + " to " + rounded(parameter.searched_high, 3) +
         (parameter.unit.empty() ? "" : " " + parameter.unit);
}

std::string windows_text(const ParameterWindows& parameter) {
  std::string text;
  for (const Window& window : parameter.windows) {
    text += text.empty() ? "" : " and ";
    if (window.open_low && window.open_high)
      text += "all of " + rounded(window.low, 3) + " to " + rounded(window.high, 3);
    else if (window.open_low)
      text += "up to " + rounded(window.high, 3);
    else if (window.open_high)
      text += "from " + rounded(window.low, 3);
    else
      text += rounded(window.low, 3) + " to " + rounded(window.high, 3);
  }
  if (text.empty()) return "none from " + searched_text(parameter);
  return text + (parameter.unit.empty() ? "" : " " + parameter.unit);
}

}  // namespace fusee::paper
