#include "fusee/transmission/tension.h"

#include <algorithm>
#include <cmath>

#include "fusee/transmission/guide_friction.h"
#include "fusee/transmission/load.h"
#include "transmission/equations.h"

namespace fusee {
namespace {

/// [10],[11]: the angle of the triangle O-pin-C at O, before and after its side pin–C grew by the elongation. Where the
/// sides no longer meet, the joint has turned until they lie in one line.
double turned_by_law_of_cosines(const PinPlace& place, double span, double elongation) {
  const double to_pin = place.pin().norm();
  const auto angle_at_joint = [&](double opposite) {
    const double cosine = (place.R * place.R + to_pin * to_pin - opposite * opposite) / (2.0 * place.R * to_pin);
    return std::acos(std::clamp(cosine, -1.0, 1.0));
  };
  return angle_at_joint(span + elongation) - angle_at_joint(span);
}

/// [d2] Of what lies on a drum and slides towards the span as a load comes on, the tension falls by e^{−μψ}: it
/// stretches as so much less of tendon, mm.
double spared_by_drum(const Mechanism& mechanism, const PinPlace& place, double image_theta) {
  const double mu = mechanism.joint.drum_mu;
  if (!(mu > 0 && place.drum > 0)) return 0;
  const UpperSpan span = upper_span(place, image_theta);
  const double left = std::exp(-mu * span.on_drum);
  return place.drum * (span.on_drum - (1.0 - left) / mu) + span.behind_drum * (1.0 - left);
}

}  // namespace

// [6] the tip force acts across OC, tendon 2 at γ2 to it: F_c R = T2 m2 with m2 = R sin γ2.
// [10],[11] the elongation turns the joint: by the law of cosines over point pins, for which alone it holds, and over
// others by its own first order.
PaperForces paper_forces(const Mechanism& mechanism, const TransmissionPoint& point) {
  const bool by_first = load_torque(mechanism, point.theta) < 0;
  const Side side = by_first ? Side::left : Side::right;
  const TendonPoint& tendon = by_first ? point.t1 : point.t2;
  const double stiffness = section_stiffness(mechanism.tendon);
  PaperForces forces;
  // C lies at 90° − θ from O, the tendon's line at its normal: in the image γ = θ + ψ, beyond 90° too.
  forces.gamma1 = k_pi - point.t1.upper_normal - point.theta;
  forces.gamma2 = point.t2.upper_normal + point.theta;
  if (!mechanism.joint.is_plain()) {
    // The same angle at the end of each tendon, wherever that is.
    const auto at_end = [&](Side end) {
      const PinPlace place = pin_place(mechanism, end, mechanism.seen_pitch_radius());
      const double theta = mirror_sign(end) * point.theta;
      return upper_span(place, theta).end_normal + theta + place.twist;
    };
    forces.gamma1 = at_end(Side::left);
    forces.gamma2 = at_end(Side::right);
  }
  const double T = tension_above_pin(std::abs(load_torque(mechanism, point.theta)), tendon.m);
  (by_first ? forces.T1 : forces.T2) = T;
  forces.phi = point.t2.wrap;
  forces.Tb = mechanism.guides.kind == GuideKind::idler
                  ? T * std::exp(guide_friction(mechanism).log_ratio(tendon.wrap))
                  : tension_below_pin(T, mechanism.guides.mu, std::max(0.0, tendon.wrap));
  const double on_pin = tendon.length - tendon.free_upper - tendon.lower_reach - tendon.in_sheath;
  const SheathLoad sheath = sheath_load(mechanism);
  // A sheath that gives way is so much more tendon in it.
  const double sheathed = sheath.length + stiffness * sheath.give;
  if (mechanism.sheath.is_there()) {
    const double off_pin = forces.Tb;
    forces.Tb *= std::exp(sheath.log_ratio);
    forces.elongation = elongation_of_tendon(T, off_pin, tendon.free_upper, on_pin, 0.0, stiffness) +
                        elongation_of_tendon(off_pin, forces.Tb, 0.0, sheathed, tendon.lower_reach, stiffness);
  } else {
    forces.elongation = elongation_of_tendon(T, forces.Tb, tendon.free_upper, on_pin, tendon.lower_reach, stiffness);
  }
  const PinPlace place = pin_place(mechanism, side, mechanism.seen_pitch_radius());
  const double spared = spared_by_drum(mechanism, place, mirror_sign(side) * point.theta);
  forces.elongation -= T * spared / stiffness;
  const double turned = mechanism.has_point_pins() ? turned_by_law_of_cosines(pin_place(mechanism, side, 0.0),
                                                                              tendon.free_upper, forces.elongation)
                                                   : angle_of_elongation(forces.elongation, tendon.m);
  forces.theta_error = by_first ? -turned : turned;
  forces.motor_torque = (by_first ? -1.0 : 1.0) * forces.Tb * tendon.p;
  forces.stiffness = stiffness * tendon.m * tendon.m / (tendon.length - spared + stiffness * sheath.give);
  return forces;
}

}  // namespace fusee
