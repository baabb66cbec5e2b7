/// \file
/// A joint on its bench, step by step: two elastic tendons in two spans each, stick-slip at the pins, slack.
///
/// Beside equilibrium.h's model in two things: what is wound on a pulley carries the strain of home, not that of the moment it was
/// wound at, and tendons may be too long. Nothing is kept of energies: this runs thousands of times in a fit.
#pragma once

#include <array>
#include <optional>

#include "fusee/transmission/joint_model.h"

namespace fusee {

class BenchMotion {
 public:
  /// At home, unloaded. `slack`: material of both tendons together beyond what `model.pretension` needs, mm.
  BenchMotion(const JointModel& model, double slack);
  /// θ at the next pulley angle under a torque against +θ (N·mm) beside the weight; null where nothing holds the joint. Steps of some degrees.
  std::optional<double> to(double alpha, double torque);

 private:
  struct Tendon {
    double sign = 1;
    double rim = 0;  ///< normal of the rim's point between upper and lower span, rad
    double upper_material = 0;
    double lower_material = 0;
    double density = 1;  ///< material per length at home
    double wound = 0;    ///< arc on the pulley that lower_material is reckoned at
  };
  struct Pull {
    double value = 0;
    double slope = 0;
    double crossed = 0;
  };
  Pull pull(const Tendon& tendon, const LowerPath& path, const PinPlace& place, double theta) const;

  const JointModel& model_;
  std::array<Tendon, 2> tendons_;
  double theta_ = 0;
  double expected_ = 0;
};

}  // namespace fusee
