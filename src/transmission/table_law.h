/// \file
/// A smooth θ(α) through the rows of a table.
#pragma once

#include <memory>
#include <unsupported/Eigen/Splines>
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
/// curvature of the pulley contains, is still smooth. Beyond its ends it goes on with the end's value and slopes (Taylor).
struct Transmission::TableLaw {
 public:
  explicit TableLaw(const std::vector<LawRow>& rows);
  LawValue at(double alpha) const;
  double first_alpha() const { return first_; }
  double last_alpha() const { return first_ + span_; }

 private:
  Eigen::Spline<double, 1> spline_;
  double first_ = 0;
  double span_ = 1;
};

}  // namespace fusee
