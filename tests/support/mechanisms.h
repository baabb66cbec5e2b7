/// \file
/// Mechanisms that many tests use. Units are those of fusee/mechanism.h: mm, rad, N, MPa.
#pragma once

#include "fusee/mechanism.h"

namespace fusee::testing {

/// The paper's mechanism at 100 mm with point pins, r1 20, EF 60: the reference case.
inline DeclaredMechanism reference() {
  DeclaredMechanism mechanism;
  mechanism.name = "reference";
  mechanism.joint = {100.0, radians(-30.0), radians(30.0)};  // R, range of θ
  mechanism.guides = {50.0, 50.0, -40.0, 0.0, 0.12};         // EB, ED, OE, radius, friction
  mechanism.pulley.EF = 60.0;
  mechanism.pulley.r1 = 20.0;
  mechanism.pulley.mu = 0.2;
  mechanism.tendon = {1.0, 40000.0, 5.0, 8.0};  // diameter, modulus, pretension, bend ratio
  return mechanism;
}

/// A feasible joint: pins and tendon of real size, a smaller pulley further from the pins.
inline DeclaredMechanism forearm() {
  DeclaredMechanism mechanism = reference();
  mechanism.name = "forearm";
  mechanism.guides.radius = 2.0;
  mechanism.pulley.EF = 80.0;
  mechanism.pulley.r1 = 16.0;
  return mechanism;
}

/// Both pulleys non-circular: θ = α/3.2.
inline DeclaredMechanism linear_wrist() {
  DeclaredMechanism mechanism = forearm();
  mechanism.pulley.law = Law::linear;
  mechanism.pulley.ratio = 3.2;
  mechanism.joint.theta_min = radians(-25.0);
  mechanism.joint.theta_max = radians(25.0);
  return mechanism;
}

/// An asymmetric joint.
inline DeclaredMechanism unsymmetric() {
  DeclaredMechanism mechanism = forearm();
  mechanism.guides.EB = 42.0;
  mechanism.guides.ED = 56.0;
  mechanism.guides.OE = -30.0;
  mechanism.joint.theta_min = radians(-20.0);
  mechanism.joint.theta_max = radians(32.0);
  return mechanism;
}

/// A drum on the joint with both tendons tied at its upper left, 45° from OC on the circle of the centre lines (radius
/// 8.3 mm). They stay on the drum, tendon 2 over its top. A joint with one lever point has a smaller range.
inline DeclaredMechanism finger() {
  DeclaredMechanism mechanism = reference();
  mechanism.name = "finger";
  mechanism.joint = {8.3, radians(-20.0), radians(90.0)};
  mechanism.joint.drum_radius = 8.0;
  mechanism.joint.attachment1 = mechanism.joint.attachment2 = Attachment{-5.87, 5.87};
  mechanism.guides = {12.0, 12.0, 12.0, 1.0, 0.12};
  mechanism.pulley.EF = 40.0;
  mechanism.pulley.r1 = 9.0;
  mechanism.tendon.diameter = 0.6;
  return mechanism;
}

/// Attachments in front of and behind the link with different levers; tendon 1 lies on a drum in part of the range.
inline DeclaredMechanism ankle() {
  DeclaredMechanism mechanism = reference();
  mechanism.name = "ankle";
  mechanism.joint = {60.0, radians(-30.0), radians(25.0)};
  mechanism.joint.drum_radius = 44.0;
  mechanism.joint.attachment1 = Attachment{-46.0, 22.0};
  mechanism.joint.attachment2 = Attachment{61.0, 18.0};
  mechanism.guides = {45.0, 55.0, 150.0, 3.0, 0.12};
  mechanism.pulley.EF = 110.0;
  mechanism.pulley.law = Law::linear;
  mechanism.pulley.ratio = 1.6;
  return mechanism;
}

/// A wrist with a remote motor: compliant sheaths with friction.
inline DeclaredMechanism sheathed_wrist() {
  DeclaredMechanism mechanism = linear_wrist();
  mechanism.name = "sheathed wrist";
  // Length, bend, friction, stiffness, place of the exits across and above.
  mechanism.sheath = {450.0, radians(150.0), 0.08, 200.0, 30.0, 100.0};
  return mechanism;
}

/// The mirror image of a joint.
inline Mechanism mirrored(Mechanism mechanism) {
  std::swap(mechanism.guides.EB, mechanism.guides.ED);
  std::swap(mechanism.joint.theta_min, mechanism.joint.theta_max);
  mechanism.joint.theta_min *= -1.0;
  mechanism.joint.theta_max *= -1.0;
  std::swap(mechanism.joint.attachment1, mechanism.joint.attachment2);
  for (auto* end : {&mechanism.joint.attachment1, &mechanism.joint.attachment2}) {
    if (*end) (*end)->across *= -1.0;
  }
  return mechanism;
}

/// Lengths of joint, guides, pulley, tendon and sheath times `factor`; those of a drum, attachments and the body stay.
inline Mechanism scaled(Mechanism mechanism, double factor) {
  for (double* length :
       {&mechanism.joint.R, &mechanism.guides.EB, &mechanism.guides.ED, &mechanism.guides.OE, &mechanism.guides.radius,
        &mechanism.pulley.EF, &mechanism.pulley.r1, &mechanism.tendon.diameter, &mechanism.sheath.length,
        &mechanism.sheath.exit_across, &mechanism.sheath.exit_above}) {
    *length *= factor;
  }
  return mechanism;
}

}  // namespace fusee::testing
