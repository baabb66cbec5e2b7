/// \file
/// Internal: lengths to which tendons are cut, and places of their knots, at home.
#pragma once

#include <vector>

#include "fusee/base.h"
#include "fusee/export.h"
#include "fusee/transmission.h"

namespace fusee::formats {

/// Lengths to be measured off.
struct TendonLength {
  transmission::Side side = transmission::Side::left;
  Vec2 joint_knot;           ///< C, in the frame of the mechanism, mm
  Vec3 pulley_knot;          ///< centre of the knot pocket, in the frame of the mesh, mm
  double between_knots = 0;  ///< along the tendon's centre line, mm
  /// Length between the knots, both knots, and a tail of 50 mm at each end to pull with; rounded up to 5 mm
  double cut = 0;
  double lap_at_home = 0;  ///< angle on the groove between the anchor and the take-off at home, rad
  /// Angle on the groove between the anchor and the last point of contact at full pay-out, rad
  double spare_lap = 0;
};

/// Length of a knot and the tail to pull it tight, mm.
double tendon_end(const Tendon& tendon);
/// The length, mm, rounded up to one that is convenient to measure.
double cut_length(double needed);

/// One entry for each tendon whose pulley has an anchor.
std::vector<TendonLength> tendon_lengths(const Product& product);

}  // namespace fusee::formats
