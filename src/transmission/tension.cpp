#include "fusee/transmission/tension.h"

#include <cmath>

namespace fusee {

// [6] the tip force acts across OC, tendon 2 at γ2 to it: F_c R = T2 m2 with m2 = R sin γ2.
// [7],[8] the pin takes e^{μφ}. [9] each span stretches under its own tension; the wrap on the pin under the mean of both.
// [10],[11] the elongation turns the joint by what its moment arm makes of it.
PaperForces paper_forces(const Mechanism& mechanism, const TransmissionPoint& point) {
  const TendonPoint& tendon = point.t2;
  PaperForces forces;
  forces.gamma2 = std::asin(std::min(1.0, tendon.m / mechanism.joint.R));
  forces.T2 = mechanism.load.tip_force * mechanism.joint.R / tendon.m;
  forces.phi = tendon.wrap;
  forces.Tb = forces.T2 * std::exp(mechanism.guides.mu * tendon.wrap);
  const double diameter = mechanism.tendon.diameter;
  const double stiffness = 0.25 * k_pi * diameter * diameter * mechanism.tendon.modulus;  // A E, N
  const double on_pin = tendon.length - tendon.free_upper - tendon.lower_reach;
  forces.elongation = (forces.T2 * tendon.free_upper + 0.5 * (forces.T2 + forces.Tb) * on_pin + forces.Tb * tendon.lower_reach) /
                      stiffness;
  forces.theta_error = forces.elongation / tendon.m;
  return forces;
}

}  // namespace fusee
