/// \file
/// What the third dimension does to the length of a tendon that is wound several times: a smooth function of α for each
/// tendon, which planar formulas take in as if their tendon grew by it.
#pragma once

#include <array>
#include <vector>

namespace fusee {

/// Value and derivatives of a Chebyshev series over an interval.
class SmoothSeries {
 public:
  struct Value {
    double d0 = 0, d1 = 0, d2 = 0, d3 = 0;
  };

  /// The polynomial through values at nodes(low, high, count), in their order; coefficients below `least` at its end
  /// are left out.
  SmoothSeries(double low, double high, const std::vector<double>& values, double least);

  static std::vector<double> nodes(double low, double high, int count);
  /// A little beyond the interval too.
  Value at(double x) const;

 private:
  double low_, high_;
  std::array<std::vector<double>, 4> coefficients_;  ///< of the function and of its derivatives
};

/// q(α) of both tendons, mm: L + σ = q + const, with L the planar length of the free path and σ that of what is wound.
/// Zero for planar tendons.
struct SlopedPaths {
  SmoothSeries q1;
  SmoothSeries q2;
};

}  // namespace fusee
