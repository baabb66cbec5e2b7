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
  bool before = false;
  double last = low;
  for (int i = 0; i <= steps; ++i) {
    const double value = low + (high - low) * i / steps;
    const bool here = holds(value);
    if (here && !before) windows.push_back({i == 0 ? low : border(holds, value, last), value, i == 0, false});
    if (!here && before) windows.back().high = border(holds, last, value);
    if (here && i == steps) {
      windows.back().high = high;
      windows.back().open_high = true;
    }
    before = here;
    last = value;
  }
  return windows;
}

std::string windows_text(const ParameterWindows& of) {
  std::string text;
  for (const Window& window : of.windows) {
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
  if (text.empty())
    return "nowhere in " + rounded(of.searched_low, 3) + " to " + rounded(of.searched_high, 3) +
           (of.unit.empty() ? "" : " " + of.unit);
  return text + (of.unit.empty() ? "" : " " + of.unit);
}

}  // namespace fusee::paper
