#include "mechanism/effect.h"

namespace fusee {
namespace {

double identified_section_stiffness(double stretch, const Mechanism& declared) {
  return section_stiffness(declared.tendon) / (1.0 + stretch);
}

// Uncertainty of the compliance of one metre of tendon by a ruler, relative to the declared compliance.
constexpr double k_ruler = 0.1;

std::vector<ManualReading> by_modulus(const DeclaredMechanism& declared) {
  const std::vector<double>& modulus = declared.prior.modulus;
  if (modulus.size() != 2 || !(modulus[0] > 0)) return {};
  const double ratio = declared.tendon.modulus / modulus[0];
  return {{ratio - 1.0, ratio * modulus[1] / modulus[0]}};
}

}  // namespace

Effect tendon_stretch(JointKind kind) {
  Effect effect;
  effect.name = "tendon_stretch";
  effect.place = ChainPlace::tendon;
  effect.rank = 1;
  effect.signature = "proportional to the load, zero without load; independent of direction";
  effect.separating_run = "run the same strokes at no load, at half and at full load, and at the reversed load";
  effect.correctable_by = CorrectableBy::pulley;
  if (kind == JointKind::ratio) {
    effect.correctable_by = CorrectableBy::table;
    effect.needs = {.load = true};  // with tendons, pretension is such a load
    effect.parameters = {
        {.name = "compliance_deg_per_load",
         .number = [](Imperfections& at) -> double& { return at.ratio_joint.compliance; },
         .least = -1e6,
         .most = 1e6,
         .step = 1e-3,
         .prior = radians(5.0),  // at the largest load, as for cable-driven fingers
         .prior_unit = PriorUnit::at_largest_load,
         .shown = shown::in_degrees,
         .key = key::in_degrees("compliance_deg", -360, 360, "joint declared by a ratio: rotation per unit of load")}};
    return effect;
  }
  effect.parameters = {
      {.name = "EA_N",
       .number = [](Imperfections& at) -> double& { return at.tendon.stretch; },
       .least = -0.9,
       .most = 60,
       .step = 0.01,
       .prior = 1,  // catalogue moduli of braids are known to a factor of two
       .shown = identified_section_stiffness,
       .key =
           key::plain("stretch", "", -0.999, 1e+06, "compliance of the tendon beyond the declared one, relative to it"),
       .merge_rule = MergeRule::compound,
       .by_hand = {"load a metre of the tendon with the largest load, measure its elongation, and enter the modulus as "
                   "prior.modulus_MPa",
                   k_ruler, by_modulus, "prior.modulus_MPa", HandTool::ruler}}};
  effect.starts = {{0.5}, {2.0}, {10.0}};
  return effect;
}

}  // namespace fusee
