/// \file
/// Joints and runs shared by tests of the rig.
#pragma once

#include "rig/rig.h"
#include "support/mechanisms.h"

namespace fusee::rig {

inline MadeJoint forearm_with(double modulus, double friction) {
  DeclaredMechanism mechanism = testing::forearm();
  mechanism.guides.mu = friction;
  mechanism.tendon.modulus = modulus;
  mechanism.tendon.pretension = 20;
  return make_joint(mechanism);
}
/// Frictionless pins and tendons so stiff that θ follows the law under any load.
inline const MadeJoint& stiff() {
  static const MadeJoint joint = forearm_with(1e8, 0.0);
  return joint;
}
inline const MadeJoint& soft() {
  static const MadeJoint joint = forearm_with(8000, 0.12);
  return joint;
}

inline Log run_of(const HiddenFaults& hidden, const RunPlan& plan, const MadeJoint& joint) {
  return log_runs(joint, hidden, {plan}, noiseless()).front();
}

}  // namespace fusee::rig
