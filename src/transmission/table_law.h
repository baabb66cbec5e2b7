/// \file
/// A smooth θ(α) through the rows of a table.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "fusee/transmission/transmission.h"

namespace fusee {

/// θ and its first three derivatives with respect to α.
struct LawValue {
  double theta = 0;
  double d1 = 0;
  double d2 = 0;
  double d3 = 0;
};

/// An interpolating B-spline of degree five (less for fewer than six rows): its third derivative, which the
/// curvature of the pulley contains, is still smooth. Beyond its ends it goes on with the end's value and slopes
/// (Taylor).
struct Transmission::TableLaw {
 public:
  explicit TableLaw(const std::vector<LawRow>& rows);
  LawValue at(double alpha) const;
  double first_alpha() const { return pieces_.front().begin; }
  double last_alpha() const { return last_; }
  /// Where one polynomial ends and the next begins.
  std::vector<double> breaks() const;

 private:
  /// The polynomial of one knot span, by powers of α − begin.
  struct Piece {
    double begin = 0;
    std::array<double, 6> powers{};
  };

  std::vector<Piece> pieces_;
  double last_ = 0;
};

}  // namespace fusee
