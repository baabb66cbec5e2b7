/// \file
/// What a tendon loses at a guide: on a pin that it slides over, or on an idler that turns with it; and in its sheath.
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
/// What a tendon loses in its sheath, and what the sheath adds to its length under tension. All zero without one.
struct SheathLoad {
  double length = 0;     ///< of tendon in it, mm
  double give = 0;       ///< by how much it gets shorter, and its tendon longer beside it, mm/N
  double log_ratio = 0;  ///< ln of the tensions' ratio that friction holds: μ times its bends
};

SheathLoad sheath_load(const Mechanism& mechanism);
/// The same mechanism without friction at guides and in sheaths.
Mechanism without_friction(Mechanism mechanism);

}  // namespace fusee
