/// \file
/// Internal: linear functions that are nowhere above what they stand for, over a box; what they prove together, and
/// what they cut off the box.
#pragma once

#include <array>
#include <vector>

#include "optimize/simplex.h"
#include "transmission/interval.h"

namespace fusee {

static_assert(Jet::k_most == k_most_variables);

struct Box {
  std::array<double, k_most_variables> lower{};
  std::array<double, k_most_variables> upper{};
  double bound = 0;  ///< no design of the box is better
  int cut = 0;       ///< the variable whose halving promises most
};

/// F(x) >= constant + slope · (x − corner) over the box, where F is the objective, or has to be <= 0.
struct LineBelow {
  double constant = 0;
  std::array<double, k_most_variables> slope{};
  std::array<double, k_most_variables> corner{};
  bool of_objective = false;
  std::array<double, k_most_variables> loss{};  ///< how far below F it may be for each variable's width
};

struct LeastOfLines {
  bool possible = true;                           ///< false: no design of the box keeps all of them below their limits
  double bound = 0;                               ///< the objective is nowhere below
  std::array<double, k_most_variables> lowest{};  ///< where the lines together are lowest: a guess
  std::array<double, k_most_variables> loss{};    ///< by which variable the bound may be too low
};

/// Rigorous, whatever the rounding. Cuts off the box what the lines allow nowhere with an objective of at most `limit`.
/// Needs a box whose objective is known to be `least` or more.
LeastOfLines least_of_lines(Box& box, int count, const std::vector<LineBelow>& lines, double least, double limit);
/// What each line alone cuts off. False when nothing is left.
bool cut_by_lines(Box& box, int count, const std::vector<LineBelow>& lines, double limit);

}  // namespace fusee
