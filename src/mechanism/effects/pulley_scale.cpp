#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

// Uncertainty of a print's scale from three readings of 40 mm, each uncertain by 0.1 mm.
constexpr double k_scale_by_caliper = 0.0015;

std::vector<ManualReading> by_diameters(const DeclaredMechanism& declared) {
  return hand_reading(declared.prior.pulley_scale, 1);
}

}  // namespace

Effect pulley_scale(JointKind) {
  Effect effect;
  effect.name = "pulley_scale";
  effect.place = ChainPlace::pulley;
  effect.rank = 2;
  effect.signature =
      "smooth in alpha, independent of direction and load: both pulleys too large, or too small, in proportion";
  effect.separating_run = "measure two diameters of the printed part with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "scale_percent",
       .number = [](Imperfections& at) -> double& { return at.pulley.scale; },
       .least = -0.15,
       .most = 0.15,
       .step = 2e-4,
       .prior = 0.01,  // shrinkage of printed plastics: 0.2 to 2 percent
       .shown = shown::in_percent,
       .key = key::in_percent("pulley_scale_percent", -50, 100, "relative enlargement of the made pulley"),
       .merge_rule = MergeRule::compound,
       .by_hand = {"measure two diameters of the print with a caliper and enter measured/nominal as prior.pulley_scale",
                   k_scale_by_caliper, by_diameters, "prior.pulley_scale"},
       .sign = {"both pulleys are too small", "both pulleys are too large"}}};
  return effect;
}

}  // namespace fusee
