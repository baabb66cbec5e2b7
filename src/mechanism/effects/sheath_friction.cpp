#include "fusee/mechanism/effect.h"

namespace fusee {
namespace {

double sheath_total(double added, const Mechanism& declared) {
  const double there = declared.sheath.mu * declared.sheath.bend + added;
  return there > 0 ? there : 0.0;
}

}  // namespace

// Of μ and the bends a run shows the product alone: T2/T1 = e^{μβ} [7]. A liner that wore, dirt, a sheath that lies
// in another curve than was thought. On a pin it is μφ; where the wrap φ hardly changes over the stroke the two are
// one.
Effect sheath_friction(JointKind) {
  Effect effect;
  effect.name = "sheath_friction";
  effect.place = ChainPlace::sheath;
  effect.rank = 1;
  effect.signature = "a loop that grows with load and as much at every angle, with a transition after each reversal";
  effect.separating_run =
      "lay the sheaths straighter, or in one bend more, and repeat the loaded run: friction on the pins stays";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.tendons = true, .sheath = true};
  effect.parameters = {
      {.name = "mu_bend",
       .number = [](Imperfections& at) -> double& { return at.sheath.friction; },
       .least = -2,
       .most = 2,
       .step = 5e-3,
       .prior = 0.15,  // half a turn of bends at 0.05 more; a quarter turn more at 0.1
       .shown = sheath_total,
       .key = key::plain("sheath_mu_bend", "", -20, 20, "added to sheath.friction times the bends in radians"),
       .again = WhenFoundAgain::added}};
  effect.starts = {{0.1}, {0.4}};
  return effect;
}

}  // namespace fusee
