#include "fusee/joint.h"
#include "joint/compensating_law.h"

// The corrected pulley is drawn so that the identified deviations cancel:
// - geometry, friction, tendon: part of the mechanism. The law remains the declared θ(α), with a round P1 if that
//   suffices, otherwise as a table.
// - stretch, weight: the law includes the deflection under the mean load (compensating_law).
// - scale 1 + s: an additional shrinkage.
// - radius offset, wave of the profile, runout: the curves are drawn with the opposite offset, wave and eccentricity
//   (draw_for_making).

namespace fusee::joint {
namespace {

bool changes_geometry(const Imperfections& at) {
  return at.pins.left != PinPlaceError{} || at.pins.right != PinPlaceError{} || at.pins.radius != 0 ||
         at.joint.length != 0 || at.joint.drum != DrumError{} || at.joint.end1 != AttachmentError{} ||
         at.joint.end2 != AttachmentError{};
}
bool changes_statics(const Imperfections& at) {
  return at.tendon.stretch != 0 || at.tendon.pretension != 0 || at.pins.friction != 0 ||
         at.pins.bearing_friction != 0 || at.tendon.groove_friction != 0 || at.sheath != SheathError{} ||
         at.joint.weight != WeightError{} || at.joint.mean_load != 0;
}

}  // namespace

RoundChoice round_choice(const DeclaredMechanism& declared) {
  return round_choice(declared, compensating_law(declared));
}

double assembly_angle(const DeclaredMechanism& declared) {
  return declared.transmission ? 0.0 : compensating_law(declared).home;
}

IdentifiedJoint identified_joint(const DeclaredMechanism& declared, LawSearch search) {
  const Imperfections& at = declared.identified;
  IdentifiedJoint joint{declared, at.pulley.outline};
  const bool nothing_to_do = !changes_geometry(at) && !changes_statics(at) && at.pulley.scale == 0;
  if (declared.transmission || nothing_to_do) return joint;
  joint.mechanism = identified_mechanism(declared);
  const CompensatingLaw needed = compensating_law(declared, search);
  if ((changes_geometry(at) || needed.shifted) && !needed.rows.empty()) {
    const RoundChoice choice = round_choice(declared, needed);
    if (choice.suffices) {
      joint.mechanism.pulley.r1 = choice.r1;
      joint.mechanism.joint.theta_min = needed.theta_min;
      joint.mechanism.joint.theta_max = needed.theta_max;
    } else {
      joint.mechanism = with_law(joint.mechanism, needed);
    }
  }
  joint.mechanism.material.shrinkage = 1 - (1 - joint.mechanism.material.shrinkage) * (1 + at.pulley.scale);
  return joint;
}

DeclaredMechanism expected_joint(const DeclaredMechanism& declared) {
  DeclaredMechanism expected = declared;
  static_cast<Mechanism&>(expected) = identified_joint(declared).mechanism;
  expected.identified = {};
  return expected;
}

}  // namespace fusee::joint
