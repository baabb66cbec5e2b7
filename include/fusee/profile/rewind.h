/// \file
/// Winds two inextensible strings on any pair of groove floors, by polygon geometry alone, and finds the joint angle
/// they give. Shares no equation with the synthesis: arc lengths on the polygon, tangents to discs, a root finder.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

struct RewindPoint {
  double alpha = 0;           ///< rad
  double theta_declared = 0;  ///< by the declared law, rad
  double theta = 0;           ///< with tendon 1 taut (of one string alone: with that), rad
  double slack = 0;           ///< of tendon 2 at that θ: > 0 hangs loose, < 0 would have to stretch, mm
};

struct RewindResult {
  std::vector<RewindPoint> points;
  double max_theta_error = 0;     ///< max |theta − theta_declared|, rad
  double max_theta_error_at = 0;  ///< α, rad
  double max_slack = 0;           ///< max |slack|, mm
  double max_slack_at = 0;        ///< α, rad
};

/// `floor1`, `floor2`: the groove floors in the pulley's frame at home, axis at the origin, mm; what is not convex is
/// bridged by the string. Throws InputError when a floor does not surround the axis or swallows a pin.
RewindResult rewind(const Mechanism& mechanism, const Polygon& floor1, const Polygon& floor2, int steps = 180);
/// One string alone holds the joint, that of `side`; nothing is known of the other's slack, which is given as 0.
RewindResult rewind_one(const Mechanism& mechanism, Side side, const Polygon& floor, int steps = 180);

}  // namespace fusee
