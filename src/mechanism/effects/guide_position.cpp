#include "fusee/mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

std::vector<CaliperReading> outward_by_caliper(const DeclaredMechanism& declared) {
  std::vector<CaliperReading> both = hand_reading(declared.prior.EB, declared.guides.EB);
  const std::vector<CaliperReading> right = hand_reading(declared.prior.ED, declared.guides.ED);
  both.insert(both.end(), right.begin(), right.end());
  return both;
}

/// The pulley's axis stays where it is declared: pins further down are pins closer to it.
std::vector<CaliperReading> down_by_caliper(const DeclaredMechanism& declared) {
  std::vector<CaliperReading> both = hand_reading(declared.prior.OE, declared.guides.OE);
  const std::vector<double>& EF = declared.prior.EF;
  if (EF.size() == 2) both.push_back({declared.pulley.EF - EF[0], EF[1]});
  return both;
}

}  // namespace

Effect guide_position(JointKind) {
  Effect effect;
  effect.name = "guide_position";
  effect.place = ChainPlace::pins;
  effect.rank = 3;
  effect.signature = "smooth in theta, no direction, no load";
  effect.separating_run = "measure the pins' distance from each other and from the joint's axis with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "outward_mm",
       .number = [](Imperfections& at) -> double& { return at.pins.place.outward; },
       .least = -20,
       .most = 20,
       .step = 1e-2,
       .prior = 1,  // holes drilled or printed by hand
       .shown = shown::as_is,
       .key = key::plain("guide_outward_mm", "mm", -10000, 10000, "added to guides.EB_mm and ED_mm"),
       .again = WhenFoundAgain::added,
       .by_hand = {"measure the pins' distance from the middle and write [prior] EB_mm and ED_mm", k_caliper,
                   outward_by_caliper},
       .sign = {"pins too near to the middle", "pins too far from the middle"}},
      {.name = "down_mm",
       .number = [](Imperfections& at) -> double& { return at.pins.place.down; },
       .least = -20,
       .most = 20,
       .step = 1e-2,
       .prior = 1,  // holes drilled or printed by hand
       .shown = shown::as_is,
       .key = key::plain("guide_down_mm", "mm", -10000, 10000, "added to guides.OE_mm, taken from pulley.EF_mm"),
       .again = WhenFoundAgain::added,
       .by_hand = {"measure how far below the joint's axis the pins lie (above it: negative) and write [prior] OE_mm",
                   k_caliper, down_by_caliper},
       .sign = {"pins too high", "pins too low"}}};
  return effect;
}

}  // namespace fusee
