/// \file
/// Friction of a tendon at its guide (a fixed pin or a turning idler) and in its sheath.
#pragma once

#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// Friction of one guide. It bounds the ratio of the tensions on both sides; while the tendon slides, the ratio is at
/// its bound.
struct GuideFriction {
  double mu = 0;  ///< friction coefficient of a pin (capstan)
  /// Idlers: bearing friction coefficient × bearing radius / idler radius to the tendon's centre line.
  double turning = 0;
  bool is_idler = false;

  /// Ln of the bound on the tension ratio at a wrap angle (rad); 0 where the tendon has left the guide.
  double log_ratio(double wrap) const;
  /// Derivative of log_ratio() by a wrap above 0.
  double slope(double wrap) const;
};

GuideFriction guide_friction(const Mechanism& mechanism);
/// Friction and compliance of a tendon's sheath. All zero without a sheath.
struct SheathLoad {
  double length = 0;      ///< length of the tendon in the sheath, mm
  double compliance = 0;  ///< axial compliance of the sheath: it shortens and the tendon gains length, mm/N
  double log_ratio = 0;   ///< ln of the bound on the tension ratio: μ × total bend
};

SheathLoad sheath_load(const Mechanism& mechanism);
/// A copy of the mechanism without friction at guides and in sheaths.
Mechanism without_friction(Mechanism mechanism);

}  // namespace fusee
