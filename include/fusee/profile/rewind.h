/// \file
/// Independent verification: winds two inextensible strings on a pair of groove floors and finds the resulting joint
/// angle. Polygon geometry only (arc lengths, tangents to discs, root finding); no equation is shared with the
/// synthesis.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

struct RewindPoint {
  double alpha = 0;           ///< rad
  double theta_declared = 0;  ///< by the target motion, rad
  double theta = 0;           ///< with tendon 1 taut (or with the only string), rad
  double slack = 0;           ///< slack of tendon 2 at that θ: > 0 hangs loose, < 0 would have to stretch, mm
};

struct RewindResult {
  std::vector<RewindPoint> points;
  double max_theta_error = 0;     ///< max |theta − theta_declared|, rad
  double max_theta_error_at = 0;  ///< α, rad
  double max_slack = 0;           ///< max |slack|, mm
  double max_slack_at = 0;        ///< α, rad
};

/// `floor1`, `floor2`: the groove floors in the pulley's frame at home, axis at the origin, mm. The string bridges
/// hollows. Throws InputError when a floor does not surround the axis or contains a pin.
RewindResult rewind(const Mechanism& mechanism, const Polygon& floor1, const Polygon& floor2, int steps = 180);
/// Winds only the string of `side`, which then determines the joint angle; the slack is reported as 0.
RewindResult rewind_one(const Mechanism& mechanism, Side side, const Polygon& floor, int steps = 180);

}  // namespace fusee
