/// \file
/// Internal: small linear programs in floating-point numbers. The result is an estimate, from which relaxation.cpp
/// makes proofs.
#pragma once

#include <array>
#include <limits>
#include <vector>

namespace fusee::optimize {

constexpr int k_max_variables = 8;
inline constexpr double k_infinite = std::numeric_limits<double>::infinity();

/// Minimizes t over 0 <= y <= 1 and t >= least_t subject to  a·y + b <= s t  in every row.
struct LinearProgram {
  struct Row {
    std::array<double, k_max_variables> a{};
    double b = 0;
    double s = 0;
  };
  int variables = 0;
  double least_t = 0;
  std::vector<Row> rows;
};

/// Minimum of a linear program.
struct LinearAnswer {
  bool possible = true;  ///< false: no y satisfies all rows, as `weights` prove
  double t = 0;
  std::array<double, k_max_variables> y{};
  /// >= 0, one per row: t is at least the weighted sum of the rows (or that sum is always positive)
  std::vector<double> weights;
};

/// Dual simplex method with bounds. Stops when t exceeds `enough`.
LinearAnswer solve(const LinearProgram& program, double enough);

}  // namespace fusee::optimize
