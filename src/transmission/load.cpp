#include "fusee/transmission/load.h"

#include <cmath>

#include "transmission/equations.h"

namespace fusee {

double weight_moment(const Load& load) { return load.mass * k_gravity * load.lever; }

double load_torque(const Mechanism& mechanism, double theta) {
  const Load& load = mechanism.load;
  return load.tip_force * mechanism.joint.R + load.torque + weight_moment(load) * std::sin(load.tilt - theta);
}

}  // namespace fusee
