#include "fusee/transmission/load.h"

#include <cmath>

namespace fusee {

double weight_moment(const Load& load) { return load.mass * k_gravity * load.lever; }

double load_torque(const Mechanism& mechanism, double theta) {
  const Load& load = mechanism.load;
  return load.tip_force * mechanism.joint.R + load.torque + weight_moment(load) * std::sin(load.tilt - theta);
}

double section_stiffness(const Tendon& tendon) {
  return tendon.modulus * 0.25 * k_pi * tendon.diameter * tendon.diameter;
}

}  // namespace fusee
