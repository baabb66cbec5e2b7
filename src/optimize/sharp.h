/// \file
/// Internal: enclosures of the directions of a tendon's two straight lines over a box of designs, tighter than by
/// interval arithmetic alone, which overestimates formulas with repeated variables. The partial derivatives of each
/// direction are known in closed form; where one has a constant sign, the ends of the box give the ends of the
/// direction.
#pragma once

#include "transmission/equations.h"
#include "transmission/interval.h"

namespace fusee::optimize {

/// A straight line of a tendon, with derivatives by the variables.
struct SharpLine {
  transmission::Jet normal;
  transmission::Jet reach;  ///< from C or the foot of the perpendicular to the pin's tangent point
};

/// Line above a pin, in the link's frame (upper_line() over offset_from_pin_in_link()).
SharpLine sharp_upper_line(const transmission::Jet& R, const transmission::Jet& e, const transmission::Jet& oe,
                           const transmission::Jet& rho, const transmission::RotationAngle<transmission::Jet>& theta,
                           transmission::Domain& domain);
/// Line below a pin at (e, ef) from the pulley's axis (lower_line()).
SharpLine sharp_lower_line(const transmission::Jet& p, const transmission::Jet& rho, const transmission::Jet& e,
                           const transmission::Jet& ef, transmission::Domain& domain);

}  // namespace fusee::optimize
