#include "transmission/load.h"

#include <cmath>

#include "transmission/equations.h"

namespace fusee::transmission {

double weight_moment(const Load& load) { return load.mass_kg * k_gravity * load.lever; }

double load_torque(const Mechanism& mechanism, double theta) {
  const Load& load = mechanism.load;
  const double torque =
      load.tip_force * mechanism.joint.R + load.torque + weight_moment(load) * elementary::sin(load.tilt - theta);
  return mechanism.spring == Spring{} ? torque : torque + mechanism.spring.torque(theta);
}

TorqueOverTheta law_load_torque(const Mechanism& mechanism, double theta) {
  const JointLoad carried = mechanism.law_load.value_or(JointLoad{mechanism.joint.R, mechanism.load, mechanism.spring});
  const Load& load = carried.load;
  const double weight = weight_moment(load), weight_torque = weight * elementary::sin(load.tilt - theta);
  return {load.tip_force * carried.lever + load.torque + weight_torque + carried.spring.torque(theta),
          carried.spring.stiffness - weight * elementary::cos(load.tilt - theta), -weight_torque};
}

void keep_law(Mechanism& mechanism) {
  if (mechanism.pulley.law != Law::torque || mechanism.law_load) return;
  mechanism.law_load = JointLoad{mechanism.joint.R, mechanism.load, mechanism.spring};
}

}  // namespace fusee::transmission
