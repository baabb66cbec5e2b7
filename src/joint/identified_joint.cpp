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

bool changes_geometry(const Imperfections& errors) {
  return errors.pins.left != PinPlaceError{} || errors.pins.right != PinPlaceError{} || errors.pins.radius != 0 ||
         errors.joint.length != 0 || errors.joint.drum != DrumError{} || errors.joint.end1 != AttachmentError{} ||
         errors.joint.end2 != AttachmentError{};
}
bool changes_statics(const Imperfections& errors) {
  return errors.tendon.stretch != 0 || errors.tendon.pretension != 0 || errors.pins.friction != 0 ||
         errors.pins.bearing_friction != 0 || errors.tendon.groove_friction != 0 || errors.sheath != SheathError{} ||
         errors.joint.weight != WeightError{} || errors.joint.mean_load != 0;
}

}  // namespace

RoundChoice round_choice(const DeclaredMechanism& declared) {
  return round_choice(declared, compensating_law(declared));
}

double assembly_angle(const DeclaredMechanism& declared) {
  return declared.transmission ? 0.0 : compensating_law(declared).home;
}

IdentifiedJoint identified_joint(const DeclaredMechanism& declared, LawSearch search) {
  const Imperfections& errors = declared.identified;
  IdentifiedJoint joint{declared, errors.pulley.outline};
  const bool nothing_to_do = !changes_geometry(errors) && !changes_statics(errors) && errors.pulley.scale == 0;
  if (declared.transmission || nothing_to_do) return joint;
  joint.mechanism = identified_mechanism(declared);
  const CompensatingLaw compensating = compensating_law(declared, search);
  if ((changes_geometry(errors) || compensating.shifted) && !compensating.rows.empty()) {
    const RoundChoice choice = round_choice(declared, compensating);
    if (choice.suffices) {
      joint.mechanism.pulley.r1 = choice.r1;
      joint.mechanism.joint.theta_min = compensating.theta_min;
      joint.mechanism.joint.theta_max = compensating.theta_max;
    } else {
      joint.mechanism = with_law(joint.mechanism, compensating);
    }
  }
  joint.mechanism.material.shrinkage = 1 - (1 - joint.mechanism.material.shrinkage) * (1 + errors.pulley.scale);
  return joint;
}

DeclaredMechanism expected_joint(const DeclaredMechanism& declared) {
  DeclaredMechanism expected = declared;
  static_cast<Mechanism&>(expected) = identified_joint(declared).mechanism;
  expected.identified = {};
  return expected;
}

}  // namespace fusee::joint
