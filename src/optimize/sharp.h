/// \file
/// Internal: the directions of a tendon's two straight lines over a box of designs, sharper than the formulas alone
/// give them. A formula in which a number stands several times overestimates; but how each direction answers to each
/// length is known in closed form, and where that has one sign the ends of the box give the ends of the direction.
#pragma once

#include "transmission/equations.h"
#include "transmission/interval.h"

namespace fusee {

struct SharpLine {
  Jet normal;
  Jet reach;  ///< C or foot of the perpendicular to the pin's tangent point
};

/// Above a pin, in the link's frame (upper_line() over offset_from_pin_in_link()).
SharpLine sharp_upper_line(const Jet& R, const Jet& e, const Jet& oe, const Jet& rho, const RotationAngle<Jet>& theta,
                           Domain& domain);
/// Below a pin at (e, ef) from the pulley's axis (lower_line()).
SharpLine sharp_lower_line(const Jet& p, const Jet& rho, const Jet& e, const Jet& ef, Domain& domain);

}  // namespace fusee
