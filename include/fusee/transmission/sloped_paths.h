/// \file
/// Length change of tendons wound over several turns, whose paths slope in the third dimension. It is a smooth function
/// of α per tendon, and the planar formulas treat it as a change of tendon length.
#pragma once

#include <array>
#include <vector>

namespace fusee {

/// Chebyshev series over an interval, with derivatives.
class ChebyshevSeries {
 public:
  struct Value {
    double d0 = 0, d1 = 0, d2 = 0, d3 = 0;
  };

  /// Interpolates `values` at nodes(low, high, count), in their order. Trailing coefficients below `least` are dropped.
  ChebyshevSeries(double low, double high, const std::vector<double>& values, double least);

  static std::vector<double> nodes(double low, double high, int count);
  /// Value and derivatives at `x`, which may lie slightly outside the interval.
  Value at(double x) const;

 private:
  double low_, high_;
  std::array<std::vector<double>, 4> coefficients_;  ///< coefficients of the function and of its derivatives
};

/// q(α) of both tendons, mm: L + σ = q + const, where L is the planar length of the free path and σ the length wound on
/// the pulley. Zero for planar tendons.
struct SlopedPaths {
  ChebyshevSeries q1;
  ChebyshevSeries q2;
};

}  // namespace fusee
