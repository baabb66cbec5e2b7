#include "fusee/mechanism/effect.h"

namespace fusee {
namespace {

double sheath_give(double added, const Mechanism& declared) {
  const double declared_give = declared.sheath.stiffness > 0 ? 1.0 / declared.sheath.stiffness : 0.0;
  const double there = declared_give + added;
  return there > 0 ? there : 0.0;
}

}  // namespace

// A spring behind each tendon that is as soft at every angle, as which the tendon's own stretch is all but the part
// that is wound and unwound. Said as a compliance: a sheath as stiff as anyone could tell has none.
Effect sheath_stiffness(JointKind) {
  Effect effect;
  effect.name = "sheath_stiffness";
  effect.place = ChainPlace::sheath;
  effect.rank = 2;
  effect.signature = "in proportion to the tension, as much at every angle; the same both ways";
  effect.separating_run =
      "hold a caliper over a sheath from end to end and hang the load on the joint: a tendon's stretch does not show";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true, .sheath = true};
  effect.parameters = {
      {.name = "mm_per_N",
       .number = [](Imperfections& at) -> double& { return at.sheath.give; },
       .least = -1,
       .most = 1,
       .step = 2e-4,
       .prior = 0.005,  // a spiral of wire under compression, and what holds its ends: 50 N/mm and up
       .shown = sheath_give,
       .key = key::plain("sheath_give_mm_per_N", "mm_per_N", -10, 10, "added to one over sheath.stiffness_N_per_mm"),
       .again = WhenFoundAgain::added}};
  effect.starts = {{0.003}, {0.02}};
  return effect;
}

}  // namespace fusee
