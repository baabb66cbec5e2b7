#include <string>

#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

std::vector<ManualReading> left_by_caliper(const DeclaredMechanism& declared) {
  return hand_reading(declared.prior.EB, declared.guides.EB);
}
std::vector<ManualReading> right_by_caliper(const DeclaredMechanism& declared) {
  return hand_reading(declared.prior.ED, declared.guides.ED);
}

/// Readings for the height of one pin, from its own entry of [prior] (`own`) and from those of OE and EF. The pulley's
/// axis is fixed, so that lower pins are closer to it.
std::vector<ManualReading> down_by_caliper(const DeclaredMechanism& declared, const std::vector<double>& own) {
  std::vector<ManualReading> both = hand_reading(declared.prior.OE, declared.guides.OE);
  const std::vector<double>& EF = declared.prior.EF;
  if (EF.size() == 2 && !declared.sheath.is_there()) both.push_back({declared.pulley.EF - EF[0], EF[1]});
  for (const ManualReading& reading : hand_reading(own, declared.guides.OE)) both.push_back(reading);
  return both;
}
std::vector<ManualReading> left_down_by_caliper(const DeclaredMechanism& declared) {
  return down_by_caliper(declared, declared.prior.OE1);
}
std::vector<ManualReading> right_down_by_caliper(const DeclaredMechanism& declared) {
  return down_by_caliper(declared, declared.prior.OE2);
}

/// One coordinate of one pin.
EffectParameter pin_coordinate(std::string name, double& (*number)(Imperfections&), const IdentifiedKey& key,
                               const ManualMeasurement& by_hand, const SignWords& sign) {
  return {.name = std::move(name),
          .number = number,
          .least = -20,
          .most = 20,
          .step = 1e-2,
          .prior = 1,  // holes printed, or drilled by hand
          .shown = shown::as_is,
          .key = key,
          .merge_rule = MergeRule::add,
          .by_hand = by_hand,
          .sign = sign};
}

}  // namespace

// Four parameters for two pins. A rotation of both pins about the joint is equivalent to offsets of the zeros of the
// joint's angle and of the pulley's. The priors keep such undetermined combinations small.
Effect guide_position(JointKind) {
  Effect effect;
  effect.name = "guide_position";
  effect.place = ChainPlace::pins;
  effect.rank = 3;
  effect.signature = "smooth in theta, independent of direction and load";
  effect.separating_run = "measure each pin's distance from the middle and from the joint's axis with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {
      pin_coordinate("outward1_mm", [](Imperfections& at) -> double& { return at.pins.left.outward; },
                     key::plain("guide1_outward_mm", "mm", -10000, 10000, "added to guides.EB_mm"),
                     {"measure the left pin's distance from the middle and enter it as prior.EB_mm", k_caliper,
                      left_by_caliper, "prior.EB_mm"},
                     {"the left pin is too close to the middle", "the left pin is too far from the middle"}),
      pin_coordinate("down1_mm", [](Imperfections& at) -> double& { return at.pins.left.down; },
                     key::plain("guide1_down_mm", "mm", -10000, 10000,
                                "distance of the left pin below guides.OE_mm; the pulley's axis does not move"),
                     {"measure how far the left pin is below the joint's axis (above it: negative) and enter it as "
                      "prior.OE1_mm",
                      k_caliper, left_down_by_caliper, "prior.OE1_mm"},
                     {"the left pin is too high", "the left pin is too low"}),
      pin_coordinate("outward2_mm", [](Imperfections& at) -> double& { return at.pins.right.outward; },
                     key::plain("guide2_outward_mm", "mm", -10000, 10000, "added to guides.ED_mm"),
                     {"measure the right pin's distance from the middle and enter it as prior.ED_mm", k_caliper,
                      right_by_caliper, "prior.ED_mm"},
                     {"the right pin is too close to the middle", "the right pin is too far from the middle"}),
      pin_coordinate("down2_mm", [](Imperfections& at) -> double& { return at.pins.right.down; },
                     key::plain("guide2_down_mm", "mm", -10000, 10000, "distance of the right pin below guides.OE_mm"),
                     {"measure how far the right pin is below the joint's axis (above it: negative) and enter it as "
                      "prior.OE2_mm",
                      k_caliper, right_down_by_caliper, "prior.OE2_mm"},
                     {"the right pin is too high", "the right pin is too low"})};
  return effect;
}

}  // namespace fusee
