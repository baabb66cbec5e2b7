#include "fusee/mechanism/effect.h"

namespace fusee {
namespace {

double idler_total(double added, const Mechanism& declared) {
  const double there = declared.guides.bearing_friction + added;
  return there > 0 ? there : 0.0;
}

}  // namespace

// What capstan_friction is on pins. A ball bearing's coefficient is some thousandths; dry, dirty, or pressed askew it
// is twenty times that, and a bush's anyway.
Effect idler_friction(JointKind) {
  Effect effect;
  effect.name = "idler_friction";
  effect.place = ChainPlace::pins;
  effect.rank = 5;
  effect.signature = "a loop that grows with load and hardly with wrap, with a transition after each reversal";
  effect.separating_run =
      "take a tendon off and turn each idler by hand; or run at two loads, with which its loop grows";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.tendons = true, .idlers = true};
  effect.parameters = {{.name = "mu",
                        .number = [](Imperfections& at) -> double& { return at.pins.bearing_friction; },
                        .least = -1,
                        .most = 2,
                        .step = 2e-3,
                        .prior = 0.05,
                        .shown = idler_total,
                        .key = key::plain("bearing_friction", "", -2, 2, "added to guides.bearing_friction of idlers"),
                        .again = WhenFoundAgain::added}};
  effect.starts = {{0.05}, {0.3}};
  return effect;
}

}  // namespace fusee
