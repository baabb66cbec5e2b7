#include <vector>

#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

double total_drum_radius(double added, const Mechanism& declared) {
  return declared.joint.drum_radius + added > 0 ? declared.joint.drum_radius + added : 0.0;
}

std::vector<ManualReading> drum_by_caliper(const DeclaredMechanism& declared) {
  return hand_reading(declared.prior.drum_radius, declared.joint.drum_radius);
}

}  // namespace

// The radius of a drum on which both tendons stay is equivalent to a scale of both pulleys or a gain of the sensor.
// If a tendon leaves the drum, the lift-off angle depends on the radius as well.
Effect drum_radius(JointKind) {
  Effect effect;
  effect.name = "drum_radius";
  effect.place = ChainPlace::joint;
  effect.rank = 4;
  effect.signature =
      "proportional to theta where tendons lie on the drum, independent of direction; a load turns the joint less";
  effect.separating_run = "measure the drum on the joint with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true, .drum = true};
  effect.parameters = {
      {.name = "radius_mm",
       .number = [](Imperfections& at) -> double& { return at.joint.drum.radius; },
       .least = -20,
       .most = 20,
       .step = 2e-3,
       .prior = 0.3,  // printed, or turned by hand; a tendon that sinks in or rides up
       .shown = total_drum_radius,
       .key = key::plain("drum_radius_mm", "mm", -500, 500, "added to joint.drum_radius_mm"),
       .merge_rule = MergeRule::add,
       .by_hand = {"measure the drum's diameter with a caliper and enter half of it as prior.drum_radius_mm",
                   k_half_diameter, drum_by_caliper, "prior.drum_radius_mm"},
       .sign = {"the drum is smaller than declared", "the drum is larger than declared"}}};
  return effect;
}

}  // namespace fusee
