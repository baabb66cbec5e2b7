/// \file
/// Internal: both tendons of a joint wound several times, closed in length: the transmission with its sloped paths.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "fusee/helix/synthesis.h"
#include "helix/pitch_spiral.h"

namespace fusee {

/// Of one side.
struct Climb {
  double slope = 0;          ///< tan λ of the groove
  double below = 0;          ///< of the take-off at home above the end on the joint, mm
  double circumference = 0;  ///< of the shortest turn, mm
  double needed_lead = 0;    ///< over that turn: what the tightest pair of turns needs, mm
  double tightest_at = 0;    ///< ψ of the earlier turn of that pair, in the image
};

struct Windings {
  std::unique_ptr<const Transmission> transmission;
  std::shared_ptr<const SlopedPaths> paths;  ///< null where the planar curves cannot be
  std::array<Climb, 2> climbs;
  double closure = 0;  ///< by how much the tendons' lengths vary over the range, mm
};

/// +1 where the take-off rises as the image's tendon is wound: later turns are further up the spiral on both sides.
inline double climbing(Side side) { return mirror_sign(side); }
/// Rise of the sloping part of a tendon's free path.
inline double rise(const Climb& climb, Side side, double sigma) {
  return climb.below + climbing(side) * climb.slope * sigma;
}
/// Slope of the free path and angle to the groove, at a place of the curve, rad.
HelixPoint helix_point(const Climb& climb, Side side, const FreePath& path, double sigma);

/// The law's planar curves must be possible.
Windings wind(const Mechanism& mechanism, const LeastLead& least_lead, HelixLook closely);

}  // namespace fusee
