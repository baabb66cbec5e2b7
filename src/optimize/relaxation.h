/// \file
/// Internal: linear functions that bound others from below over a box, the bounds that they prove together, and the
/// parts that they cut off the box.
#pragma once

#include <array>
#include <vector>

#include "optimize/simplex.h"
#include "transmission/interval.h"

namespace fusee::optimize {

static_assert(transmission::Jet::k_most == k_max_variables);

/// A box of designs.
struct Box {
  std::array<double, k_max_variables> lower{};
  std::array<double, k_max_variables> upper{};
  double bound = 0;  ///< lower bound on all designs of the box
  int cut = 0;       ///< the variable to bisect
};

/// F(x) >= constant + slope · (x − corner) over the box, where F is the objective or a function that must be <= 0.
struct LineBelow {
  double constant = 0;
  std::array<double, k_max_variables> slope{};
  std::array<double, k_max_variables> corner{};
  bool of_objective = false;
  std::array<double, k_max_variables> loss{};  ///< possible distance below F due to each variable's width
};

/// Minimum of the objective that lines prove together.
struct LeastOfLines {
  bool possible = true;                          ///< false: no design of the box satisfies all of them
  double bound = 0;                              ///< lower bound of the objective
  std::array<double, k_max_variables> lowest{};  ///< estimated minimizer of the lines together
  std::array<double, k_max_variables> loss{};    ///< contribution of each variable to the error of the bound
};

/// Rigorous under any rounding. Cuts off the parts of the box in which the lines exclude an objective of at most
/// `limit`. `count`: number of variables; `least`: a known lower bound of the objective over the box.
LeastOfLines least_of_lines(Box& box, int count, const std::vector<LineBelow>& lines, double least, double limit);
/// Cuts with each line separately. False if nothing is left.
bool cut_by_lines(Box& box, int count, const std::vector<LineBelow>& lines, double limit);

}  // namespace fusee::optimize
