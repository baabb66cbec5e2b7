/// \file
/// A smooth θ(α) through the rows of a table.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "fusee/transmission.h"

namespace fusee::transmission {

/// θ and its first three derivatives with respect to α.
struct LawValue {
  double theta = 0;
  double d1 = 0;
  double d2 = 0;
  double d3 = 0;
};

/// An interpolating B-spline of degree five (less for fewer than six rows). The pulley's curvature contains the third
/// derivative, which is still smooth. Beyond the ends the law continues as the Taylor polynomial of degree three there.
struct Transmission::TableLaw {
 public:
  explicit TableLaw(const std::vector<LawRow>& rows);
  LawValue at(double alpha) const;
  double first_alpha() const { return pieces_.front().begin; }
  double last_alpha() const { return last_; }
  /// Values of α at which one polynomial ends and the next begins.
  std::vector<double> breaks() const;

 private:
  /// The polynomial of one knot span, in powers of α − begin.
  struct Piece {
    double begin = 0;
    std::array<double, 6> powers{};
  };

  std::vector<Piece> pieces_;
  double last_ = 0;
};

}  // namespace fusee::transmission
