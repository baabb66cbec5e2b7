#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

constexpr double k_two_diameters = 0.02;  // uncertainty of half the sum of both diameters, mm

std::vector<ManualReading> offset_by_caliper(const DeclaredMechanism& declared) {
  return hand_reading(declared.prior.radius_offset, 0);
}

}  // namespace

Effect radius_offset(JointKind) {
  Effect effect;
  effect.name = "radius_offset";
  effect.place = ChainPlace::pulley;
  effect.rank = 1;
  effect.signature =
      "smooth in alpha, independent of direction and load: both pulleys too large, or too small, by a constant";
  effect.separating_run = "measure the diameter of the pulley's groove floor and of the tendon with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "offset_mm",
       .number = [](Imperfections& at) -> double& { return at.pulley.outline.offset; },
       .least = -2,
       .most = 2,
       .step = 2e-3,
       .prior = 0.2,  // an excess line width, a tendon that lies flat
       .shown = shown::as_is,
       .key = key::plain("radius_offset_mm", "mm", -100, 100, "outward offset of the tendons on the made pulley"),
       .merge_rule = MergeRule::add,
       .by_hand =
           {"measure the diameters of the groove's floor and of the tendon with a caliper, add what each is larger "
            "than declared (negative: smaller), and enter half of the sum as prior.radius_offset_mm",
            k_two_diameters, offset_by_caliper, "prior.radius_offset_mm"},
       .sign = {"both pulleys are too small", "both pulleys are too large"}}};
  return effect;
}

}  // namespace fusee
