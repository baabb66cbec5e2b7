#include <string>

#include "fusee/mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

std::vector<CaliperReading> left_by_caliper(const DeclaredMechanism& declared) {
  return hand_reading(declared.prior.EB, declared.guides.EB);
}
std::vector<CaliperReading> right_by_caliper(const DeclaredMechanism& declared) {
  return hand_reading(declared.prior.ED, declared.guides.ED);
}

/// Place of one pin, `own`, or of both. The pulley's axis stays where it is declared: pins further down are pins closer to it.
std::vector<CaliperReading> down_by_caliper(const DeclaredMechanism& declared, const std::vector<double>& own) {
  std::vector<CaliperReading> both = hand_reading(declared.prior.OE, declared.guides.OE);
  const std::vector<double>& EF = declared.prior.EF;
  if (EF.size() == 2 && !declared.sheath.is_there()) both.push_back({declared.pulley.EF - EF[0], EF[1]});
  for (const CaliperReading& reading : hand_reading(own, declared.guides.OE)) both.push_back(reading);
  return both;
}
std::vector<CaliperReading> left_down_by_caliper(const DeclaredMechanism& declared) {
  return down_by_caliper(declared, declared.prior.OE1);
}
std::vector<CaliperReading> right_down_by_caliper(const DeclaredMechanism& declared) {
  return down_by_caliper(declared, declared.prior.OE2);
}

/// One number of one pin: `by_hand` says how it is read, `sign` what its sign means.
EffectParameter place_part(std::string name, double& (*number)(Imperfections&), const IdentifiedKey& key,
                           const ByHand& by_hand, const SignWords& sign) {
  return {.name = std::move(name),
          .number = number,
          .least = -20,
          .most = 20,
          .step = 1e-2,
          .prior = 1,  // holes drilled or printed by hand
          .shown = shown::as_is,
          .key = key,
          .again = WhenFoundAgain::added,
          .by_hand = by_hand,
          .sign = sign};
}

}  // namespace

// Four numbers for two pins. Both pins turned about the joint are a zero of the joint and pulleys tied elsewhere: what
// data do not say of them their priors keep small.
Effect guide_position(JointKind) {
  Effect effect;
  effect.name = "guide_position";
  effect.place = ChainPlace::pins;
  effect.rank = 3;
  effect.signature = "smooth in theta, no direction, no load";
  effect.separating_run = "measure each pin's distance from the middle and from the joint's axis with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {
      place_part("outward1_mm", [](Imperfections& at) -> double& { return at.pins.left.outward; },
                 key::plain("guide1_outward_mm", "mm", -10000, 10000, "added to guides.EB_mm"),
                 {"measure the left pin's distance from the middle and write [prior] EB_mm", k_caliper, left_by_caliper,
                  "prior.EB_mm"},
                 {"left pin too near to the middle", "left pin too far from the middle"}),
      place_part("down1_mm", [](Imperfections& at) -> double& { return at.pins.left.down; },
                 key::plain("guide1_down_mm", "mm", -10000, 10000,
                            "the left pin is this much lower than guides.OE_mm says; the pulley's axis stays"),
                 {"measure how far below the joint's axis the left pin lies (above it: negative) and write [prior] "
                  "OE1_mm",
                  k_caliper, left_down_by_caliper, "prior.OE1_mm"},
                 {"left pin too high", "left pin too low"}),
      place_part("outward2_mm", [](Imperfections& at) -> double& { return at.pins.right.outward; },
                 key::plain("guide2_outward_mm", "mm", -10000, 10000, "added to guides.ED_mm"),
                 {"measure the right pin's distance from the middle and write [prior] ED_mm", k_caliper,
                  right_by_caliper, "prior.ED_mm"},
                 {"right pin too near to the middle", "right pin too far from the middle"}),
      place_part("down2_mm", [](Imperfections& at) -> double& { return at.pins.right.down; },
                 key::plain("guide2_down_mm", "mm", -10000, 10000, "the same of the right pin"),
                 {"measure how far below the joint's axis the right pin lies (above it: negative) and write [prior] "
                  "OE2_mm",
                  k_caliper, right_down_by_caliper, "prior.OE2_mm"},
                 {"right pin too high", "right pin too low"})};
  return effect;
}

}  // namespace fusee
