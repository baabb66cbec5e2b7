/// \file
/// Internal: small linear programs in plain numbers. What comes out is a guess: relaxation.cpp makes proofs of it.
#pragma once

#include <array>
#include <limits>
#include <vector>

namespace fusee {

constexpr int k_most_variables = 8;
inline constexpr double k_infinite = std::numeric_limits<double>::infinity();

/// The least t over 0 <= y <= 1 and t >= least_t with  a·y + b <= s t  in every row.
struct LinearProgram {
  struct Row {
    std::array<double, k_most_variables> a{};
    double b = 0;
    double s = 0;
  };
  int variables = 0;
  double least_t = 0;
  std::vector<Row> rows;
};

struct LinearAnswer {
  bool possible = true;  ///< false: no y keeps all rows, and `weights` show it
  double t = 0;
  std::array<double, k_most_variables> y{};
  std::vector<double> weights;  ///< >= 0, one a row: t is at least their sum of the rows (or that sum stays above 0)
};

/// By the dual simplex method with bounds. Stops once t is above `enough`.
LinearAnswer solve(const LinearProgram& program, double enough);

}  // namespace fusee
