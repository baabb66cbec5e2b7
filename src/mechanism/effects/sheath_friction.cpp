#include "mechanism/effect.h"

namespace fusee {
namespace {

double total_mu_bend(double added, const Mechanism& declared) {
  const double total = declared.sheath.mu * declared.sheath.bend + added;
  return total > 0 ? total : 0.0;
}

}  // namespace

// A run determines only the product of μ and the total bend: T2/T1 = e^{μβ} [7]. Causes are a worn liner, dirt, or a
// sheath laid in another curve. On a pin the exponent is μφ; where the wrap φ is nearly constant over the stroke the
// two are equivalent.
Effect sheath_friction(JointKind) {
  Effect effect;
  effect.name = "sheath_friction";
  effect.place = ChainPlace::sheath;
  effect.rank = 1;
  effect.signature = "hysteresis that grows with load, equal at every angle, with a transition after each reversal";
  effect.separating_run =
      "lay the sheaths straighter, or in one more bend, and repeat the loaded run: friction on the pins does not "
      "change";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.tendons = true, .sheath = true};
  effect.parameters = {
      {.name = "mu_bend",
       .number = [](Imperfections& at) -> double& { return at.sheath.friction; },
       .least = -2,
       .most = 2,
       .step = 5e-3,
       .prior = 0.15,  // half a turn of bends with μ larger by 0.05; an additional quarter turn at 0.1
       .shown = total_mu_bend,
       .key = key::plain("sheath_mu_bend", "", -20, 20, "added to sheath.friction times the total bend in radians"),
       .merge_rule = MergeRule::add}};
  effect.starts = {{0.1}, {0.4}};
  return effect;
}

}  // namespace fusee
