/// \file
/// What a tendon loses at a guide: on a pin that it slides over, or on an idler that turns with it.
#pragma once

#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// The tension on one side of a guide may be so many times that on the other before the tendon moves, and is while it
/// does.
struct GuideFriction {
  double mu = 0;  ///< of a pin, capstan
  double turning =
      0;  ///< of an idler: friction of its bearing times the bearing's radius per the idler's to the centre line
  bool is_idler = false;

  /// ln of that ratio at this wrap, rad; 0 where the tendon has left the guide.
  double log_ratio(double wrap) const;
  /// Its derivative with respect to a wrap above 0.
  double slope(double wrap) const;
};

GuideFriction guide_friction(const Mechanism& mechanism);
/// The same guides without any.
Guides without_friction(Guides guides);

}  // namespace fusee
