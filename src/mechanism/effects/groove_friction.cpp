#include "mechanism/effect.h"

namespace fusee {
namespace {

double total_groove_friction(double added, const Mechanism& declared) {
  return declared.pulley.mu + added > 0 ? declared.pulley.mu + added : 0.0;
}

}  // namespace

Effect groove_friction(JointKind) {
  Effect effect;
  effect.name = "groove_friction";
  effect.place = ChainPlace::pulley;
  effect.rank = 5;
  effect.signature =
      "hysteresis under load that depends on the wound length; the first stroke differs from all later ones";
  effect.separating_run =
      "apply and remove the load three times where tendon 2 is wound furthest, and again where tendon 1 is: with "
      "groove friction, the joint yields most the first time, and most where more is wound";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.tendons = true};
  effect.parameters = {{.name = "mu",
                        .number = [](Imperfections& at) -> double& { return at.tendon.groove_friction; },
                        .least = -2,
                        .most = 2,
                        .step = 0.02,
                        .prior = 0.15,  // around the usual 0.2: HMPE has 0.05 to 0.15, steel up to 0.3, a V groove more
                        .shown = total_groove_friction,
                        .key = key::plain("groove_friction", "", -2, 2, "added to pulley.friction"),
                        .merge_rule = MergeRule::add}};
  effect.starts = {{-0.1}, {0.2}};
  return effect;
}

}  // namespace fusee
