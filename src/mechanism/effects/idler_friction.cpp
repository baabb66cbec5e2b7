#include "mechanism/effect.h"

namespace fusee {
namespace {

double total_bearing_friction(double added, const Mechanism& declared) {
  const double total = declared.guides.bearing_friction + added;
  return total > 0 ? total : 0.0;
}

}  // namespace

// The counterpart of capstan_friction for idlers. The coefficient of a ball bearing is a few thousandths; dry, dirty or
// misaligned, twenty times that, like that of a bush.
Effect idler_friction(JointKind) {
  Effect effect;
  effect.name = "idler_friction";
  effect.place = ChainPlace::pins;
  effect.rank = 5;
  effect.signature = "hysteresis that grows with load and hardly with wrap, with a transition after each reversal";
  effect.separating_run =
      "remove a tendon and turn each idler by hand; or run at two loads: the hysteresis grows with the load";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.tendons = true, .idlers = true};
  effect.parameters = {{.name = "mu",
                        .number = [](Imperfections& at) -> double& { return at.pins.bearing_friction; },
                        .least = -1,
                        .most = 2,
                        .step = 2e-3,
                        .prior = 0.05,
                        .shown = total_bearing_friction,
                        .key = key::plain("bearing_friction", "", -2, 2, "added to guides.bearing_friction of idlers"),
                        .merge_rule = MergeRule::add}};
  effect.starts = {{0.05}, {0.3}};
  return effect;
}

}  // namespace fusee
