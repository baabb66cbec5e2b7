#include <vector>

#include "fusee/mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

double drum_total(double added, const Mechanism& declared) {
  return declared.joint.drum_radius + added > 0 ? declared.joint.drum_radius + added : 0.0;
}

std::vector<CaliperReading> drum_by_caliper(const DeclaredMechanism& declared) {
  return hand_reading(declared.prior.drum_radius, declared.joint.drum_radius);
}

}  // namespace

// Where both tendons lie on the drum all along, its radius is to θ what pulleys of another size and a sensor of another
// gain are; where one leaves it, its place of lift-off moves too.
Effect drum_radius(JointKind) {
  Effect effect;
  effect.name = "drum_radius";
  effect.place = ChainPlace::joint;
  effect.rank = 4;
  effect.signature =
      "in proportion to theta where tendons lie on the drum, no direction; a load turns the joint less far";
  effect.separating_run = "measure the drum on the joint with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true, .drum = true};
  effect.parameters = {
      {.name = "radius_mm",
       .number = [](Imperfections& at) -> double& { return at.joint.drum.radius; },
       .least = -20,
       .most = 20,
       .step = 2e-3,
       .prior = 0.3,  // printed or turned by hand, a tendon that sinks in or rides up
       .shown = drum_total,
       .key = key::plain("drum_radius_mm", "mm", -500, 500, "added to joint.drum_radius_mm"),
       .again = WhenFoundAgain::added,
       .by_hand = {"measure the drum's diameter with a caliper and write half of it as [prior] drum_radius_mm",
                   k_half_diameter, drum_by_caliper, "prior.drum_radius_mm"},
       .sign = {"drum smaller than declared", "drum larger than declared"}}};
  return effect;
}

}  // namespace fusee
