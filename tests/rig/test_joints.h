/// \file
/// Joints and runs that tests of the rig share.
#pragma once

#include "rig/rig.h"
#include "support/mechanisms.h"

namespace fusee::rig {

inline SensorPlan no_noise() {
  SensorPlan sensors;
  sensors.noise = 0;
  return sensors;
}

inline MadeJoint forearm_with(double modulus, double friction) {
  DeclaredMechanism mechanism = testing::forearm();
  mechanism.guides.mu = friction;
  mechanism.tendon.modulus = modulus;
  mechanism.tendon.pretension = 20;
  return make_joint(mechanism);
}
/// Without friction at its pins, and so stiff that θ follows the law under any load.
inline const MadeJoint& stiff() {
  static const MadeJoint joint = forearm_with(1e8, 0.0);
  return joint;
}
inline const MadeJoint& soft() {
  static const MadeJoint joint = forearm_with(8000, 0.12);
  return joint;
}

inline Log run_of(const Hidden& hidden, const RunPlan& plan, const MadeJoint& joint) {
  return log_runs(joint, hidden, {plan}, no_noise()).front();
}

}  // namespace fusee::rig
