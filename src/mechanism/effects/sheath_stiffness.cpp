#include "mechanism/effect.h"

namespace fusee {
namespace {

double total_compliance(double added, const Mechanism& declared) {
  const double declared_compliance = declared.sheath.stiffness > 0 ? 1.0 / declared.sheath.stiffness : 0.0;
  const double total = declared_compliance + added;
  return total > 0 ? total : 0.0;
}

}  // namespace

// Constant series compliance behind each tendon. Collinear with tendon stretch, except for the part that winds on and
// off the pulley. Parametrized as a compliance, which is zero for an ideally stiff sheath.
Effect sheath_stiffness(JointKind) {
  Effect effect;
  effect.name = "sheath_stiffness";
  effect.place = ChainPlace::sheath;
  effect.rank = 2;
  effect.signature = "proportional to the tension, equal at every angle; independent of direction";
  effect.separating_run =
      "hold a caliper over a sheath from end to end and hang the load on the joint: tendon stretch does not show there";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true, .sheath = true};
  effect.parameters = {
      {.name = "mm_per_N",
       .number = [](Imperfections& at) -> double& { return at.sheath.compliance; },
       .least = -1,
       .most = 1,
       .step = 2e-4,
       .prior = 0.005,  // a wire spiral under compression, and its end supports: 50 N/mm and more
       .shown = total_compliance,
       .key = key::plain("sheath_give_mm_per_N", "mm_per_N", -10, 10, "added to 1 / sheath.stiffness_N_per_mm"),
       .merge_rule = MergeRule::add}};
  effect.starts = {{0.003}, {0.02}};
  return effect;
}

}  // namespace fusee
