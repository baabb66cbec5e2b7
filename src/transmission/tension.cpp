#include <algorithm>
#include <cmath>

#include "fusee/transmission.h"
#include "transmission/equations.h"
#include "transmission/load.h"

namespace fusee::transmission {
namespace {

/// [10],[11] Change of the angle at O in the triangle O-pin-C when the side pin–C grows by the elongation. If the sides
/// no longer meet, the joint has turned until they are collinear.
double turned_by_law_of_cosines(const PinPlace& place, double span, double elongation) {
  const double to_pin = place.pin().norm();
  const auto angle_at_joint = [&](double opposite) {
    const double cosine = (place.R * place.R + to_pin * to_pin - opposite * opposite) / (2.0 * place.R * to_pin);
    return elementary::acos(std::clamp(cosine, -1.0, 1.0));
  };
  return angle_at_joint(span + elongation) - angle_at_joint(span);
}

/// [d2] of physics.md. As the load grows, the tendon on the drum slides towards the span, and its tension decays by
/// e^{−μψ} with the wrap ψ. Returns the length by which this shortens the stretching tendon, mm.
double length_relieved_by_drum(const Mechanism& mechanism, const PinPlace& place, double image_theta) {
  const double mu = mechanism.joint.drum_mu;
  if (!(mu > 0 && place.drum > 0)) return 0;
  const UpperSpan span = upper_span(place, image_theta);
  const double decay = elementary::exp(-mu * span.on_drum);
  return place.drum * (span.on_drum - (1.0 - decay) / mu) + span.behind_drum * (1.0 - decay);
}

}  // namespace

// [6] The tip force acts across OC, and tendon 2 at the angle γ2 to OC: F_c R = T2 m2 with m2 = R sin γ2. [10],[11] The
// elongation turns the joint. The law of cosines holds only over point pins; over thicker pins, the rotation is
// computed to first order.
PaperForces paper_forces(const Mechanism& mechanism, const TransmissionPoint& point) {
  const bool loads_tendon1 = load_torque(mechanism, point.theta) < 0;
  const Side side = loads_tendon1 ? Side::left : Side::right;
  const TendonPoint& tendon = loads_tendon1 ? point.t1 : point.t2;
  const double stiffness = section_stiffness(mechanism.tendon);
  PaperForces forces;
  // In the right-hand image, C lies in the direction 90° − θ from O, and ψ is the direction of the line's normal.
  // Therefore γ = θ + ψ, also beyond 90°.
  forces.gamma1 = k_pi - point.t1.upper_normal - point.theta;
  forces.gamma2 = point.t2.upper_normal + point.theta;
  if (!mechanism.joint.is_plain()) {
    // The angle at each tendon's own end.
    const auto at_end = [&](Side end) {
      const PinPlace place = pin_place(mechanism, end, mechanism.seen_pitch_radius());
      const double theta = mirror_sign(end) * point.theta;
      return upper_span(place, theta).end_normal + theta + place.twist;
    };
    forces.gamma1 = at_end(Side::left);
    forces.gamma2 = at_end(Side::right);
  }
  const double T = tension_above_pin(std::abs(load_torque(mechanism, point.theta)), tendon.m);
  (loads_tendon1 ? forces.T1 : forces.T2) = T;
  forces.phi = point.t2.wrap;
  forces.Tb = mechanism.guides.kind == GuideKind::idler
                  ? T * elementary::exp(guide_friction(mechanism).log_ratio(tendon.wrap))
                  : tension_below_pin(T, mechanism.guides.mu, std::max(0.0, tendon.wrap));
  const double on_pin = tendon.length - tendon.free_upper - tendon.lower_reach - tendon.in_sheath;
  const SheathLoad sheath = sheath_load(mechanism);
  // The compliance of the sheath acts as an additional length of tendon.
  const double sheathed = sheath.length + stiffness * sheath.compliance;
  if (mechanism.sheath.is_there()) {
    const double off_pin = forces.Tb;
    forces.Tb *= elementary::exp(sheath.log_ratio);
    forces.elongation = elongation_of_tendon(T, off_pin, tendon.free_upper, on_pin, 0.0, stiffness) +
                        elongation_of_tendon(off_pin, forces.Tb, 0.0, sheathed, tendon.lower_reach, stiffness);
  } else {
    forces.elongation = elongation_of_tendon(T, forces.Tb, tendon.free_upper, on_pin, tendon.lower_reach, stiffness);
  }
  const PinPlace place = pin_place(mechanism, side, mechanism.seen_pitch_radius());
  const double relieved = length_relieved_by_drum(mechanism, place, mirror_sign(side) * point.theta);
  forces.elongation -= T * relieved / stiffness;
  const double turned = mechanism.has_point_pins() ? turned_by_law_of_cosines(pin_place(mechanism, side, 0.0),
                                                                              tendon.free_upper, forces.elongation)
                                                   : angle_of_elongation(forces.elongation, tendon.m);
  forces.theta_error = loads_tendon1 ? -turned : turned;
  forces.motor_torque = (loads_tendon1 ? -1.0 : 1.0) * forces.Tb * tendon.p;
  forces.stiffness = stiffness * tendon.m * tendon.m / (tendon.length - relieved + stiffness * sheath.compliance);
  return forces;
}

}  // namespace fusee::transmission
