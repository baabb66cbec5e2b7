/// \file
/// Internal: golden-section search.
#pragma once

namespace fusee {

/// An interval of a function's argument.
struct Bracket {
  double low = 0;
  double high = 0;

  double middle() const { return 0.5 * (low + high); }
};

/// Narrows `bracket` around the minimum of a unimodal function. Each of the `steps` golden sections leaves 0.618 of the
/// width and reuses one of the two earlier values. The evaluation points depend on the bracket and on the comparisons
/// of values alone.
template <typename Value>
Bracket golden_section(Bracket bracket, int steps, Value value) {
  constexpr double golden = 0.61803398874989485;
  const auto left = [&bracket] { return bracket.high - golden * (bracket.high - bracket.low); };
  const auto right = [&bracket] { return bracket.low + golden * (bracket.high - bracket.low); };
  double at_left = value(left()), at_right = value(right());
  for (int i = 0; i < steps; ++i) {
    if (at_left < at_right) {
      bracket.high = right();
      at_right = at_left;
      at_left = value(left());
    } else {
      bracket.low = left();
      at_left = at_right;
      at_right = value(right());
    }
  }
  return bracket;
}

}  // namespace fusee
