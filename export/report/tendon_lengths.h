/// \file
/// How long to cut the tendons and where their knots lie, at home.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/export/product.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

/// What a person measures off, the same wherever it is said.
struct TendonLength {
  Side side = Side::left;
  Vec2 joint_knot;           ///< C, in the frame of the mechanism, mm
  Vec3 pulley_knot;          ///< middle of the knot pocket, in the frame of the mesh, mm
  double between_knots = 0;  ///< along the tendon's centre line, mm
  double cut = 0;          ///< between the knots, both knots, and a tail of 50 mm at each end to pull with; whole 5 mm
  double lap_at_home = 0;  ///< on the groove between the anchor and where it leaves at home, rad
  double spare_lap = 0;    ///< on the groove between the anchor and the last point of contact at full pay-out, rad
};

/// What a knot and the tail to pull it tight with take of a tendon, mm.
double tendon_end(const Tendon& tendon);
/// The next length that is easily measured off, mm.
double cut_length(double needed);

/// Of each tendon whose pulley has an anchor.
std::vector<TendonLength> tendon_lengths(const Product& product);

}  // namespace fusee
