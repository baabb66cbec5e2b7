#include "fusee/mechanism/effect.h"

namespace fusee {
namespace {

double whole_friction(double added, const Mechanism& declared) {
  const Guides& guides = declared.guides;
  const double there = guides.kind == GuideKind::idler ? guides.bearing_friction : guides.mu;
  return there + added > 0 ? there + added : 0.0;
}

}  // namespace

Effect capstan_friction(JointKind kind) {
  Effect effect;
  effect.name = "capstan_friction";
  effect.place = ChainPlace::pins;
  effect.rank = 1;
  effect.signature = "a loop that grows with load and wrap, with a transition after each reversal";
  effect.separating_run = "run at two loads: friction's loop grows with the load, backlash's does not";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {};
  if (kind == JointKind::ratio) {
    effect.needs = {.load = true};
    effect.parameters = {
        {.name = "half_loop_deg_per_load",
         .number = [](Imperfections& at) -> double& { return at.ratio_joint.dry_friction; },
         .least = 0,
         .most = 1e6,
         .step = 1e-3,
         .prior = radians(2.0),  // at the largest load: a sheathed cable loses some tenths of its stretch
         .prior_at_load = true,
         .shown = shown::in_degrees,
         .key = key::in_degrees("dry_friction_deg", -360, 360,
                                "of a joint declared by a ratio: half loop per unit of load")}};
    return effect;
  }
  effect.needs = {.pins = true};
  effect.parameters = {
      {.name = "mu",
       .number = [](Imperfections& at) -> double& { return at.pins.friction; },
       .least = -1,
       .most = 2,
       .step = 5e-3,
       .prior = 0.15,  // steel or HMPE over metal pins 0.05 to 0.4, declared 0.1 to 0.2
       .shown = whole_friction,
       .key = key::plain("friction", "", -2, 2, "added to guides.friction, of idlers to guides.bearing_friction"),
       .again = WhenFoundAgain::added}};
  effect.starts = {{0.1}, {0.4}};
  return effect;
}

}  // namespace fusee
