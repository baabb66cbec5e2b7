#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

double total_radius(double added, const Mechanism& declared) {
  return declared.guides.radius + added > 0 ? declared.guides.radius + added : 0.0;
}

std::vector<ManualReading> radius_by_caliper(const DeclaredMechanism& declared) {
  return hand_reading(declared.prior.guide_radius, declared.guides.radius);
}

}  // namespace

Effect guide_radius(JointKind) {
  Effect effect;
  effect.name = "guide_radius";
  effect.place = ChainPlace::pins;
  effect.rank = 2;
  effect.signature = "smooth in theta, independent of direction; grows towards both ends of the range";
  effect.separating_run = "measure the guide pins with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "radius_mm",
       .number = [](Imperfections& at) -> double& { return at.pins.radius; },
       .least = -20,
       .most = 20,
       .step = 5e-3,
       .prior = 0.5,  // a bushing, a pin of the next size
       .shown = total_radius,
       .key = key::plain("guide_radius_mm", "mm", -500, 500, "added to guides.radius_mm"),
       .merge_rule = MergeRule::add,
       .by_hand = {"measure the guide pins' diameter with a caliper and enter half of it as prior.guide_radius_mm",
                   k_half_diameter, radius_by_caliper, "prior.guide_radius_mm"},
       .sign = {"the pins are thinner than declared", "the pins are thicker than declared"}}};
  return effect;
}

}  // namespace fusee
