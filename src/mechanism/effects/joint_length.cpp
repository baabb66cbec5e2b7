#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

double total_length(double added, const Mechanism& declared) { return declared.joint.R + added; }

std::vector<ManualReading> length_by_caliper(const DeclaredMechanism& declared) {
  return hand_reading(declared.prior.length, declared.joint.R);
}

}  // namespace

Effect joint_length(JointKind) {
  Effect effect;
  effect.name = "joint_length";
  effect.place = ChainPlace::joint;
  effect.rank = 1;
  effect.signature = "smooth in theta, independent of direction; a load turns the joint further in proportion";
  effect.separating_run = "measure from the joint's axis to the tendons' attachment with a caliper";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "length_mm",
       .number = [](Imperfections& at) -> double& { return at.joint.length; },
       .least = -50,
       .most = 50,
       .step = 1e-2,
       .prior = 1,  // uncertainty of a tied and bent tendon
       .shown = total_length,
       .key = key::plain("length_mm", "mm", -10000, 10000, "added to joint.length_mm"),
       .merge_rule = MergeRule::add,
       .by_hand = {"measure from the joint's axis to the tendons' attachment and enter it as prior.length_mm",
                   k_caliper, length_by_caliper, "prior.length_mm"},
       .sign = {"the link is shorter than declared", "the link is longer than declared"}}};
  return effect;
}

}  // namespace fusee
