#include "mechanism/effect.h"

namespace fusee {
namespace {

/// The coefficient as reported: declared plus identified, at least 0.
double total_friction(double added, const Mechanism& declared) {
  const Guides& guides = declared.guides;
  const double declared_mu = guides.kind == GuideKind::idler ? guides.bearing_friction : guides.mu;
  return declared_mu + added > 0 ? declared_mu + added : 0.0;
}

/// Parameters for a joint declared by a ratio, whose model is RubbingCable (joint/rubbing_cable.h).
std::vector<EffectParameter> friction_of_cable() {
  return {{.name = "share_of_load",
           .number = [](Imperfections& at) -> double& { return at.ratio_joint.friction.share; },
           .least = 0,
           .most = 2,
           .step = 5e-3,
           // Mean along the cable, to first order half of μφ: 0.08 for one bend of 90° at μ = 0.1, 0.35 for three at
           // 0.15.
           .prior = 0.15,
           .shown = shown::as_is,
           .key = key::plain("friction_share", "", 0, 100,
                             "joint declared by a ratio: cable friction as a fraction of the load")},
          {.name = "friction_without_load",
           .number = [](Imperfections& at) -> double& { return at.ratio_joint.friction.unloaded; },
           .least = 0,
           .most = 1e6,
           .step = 1e-3,
           .prior = 0.1,  // pretension of two thirds of the largest load, at that share
           .prior_unit = PriorUnit::of_largest_load,
           .shown = shown::as_is,
           .key = key::plain("friction_without_load", "", 0, 1e7,
                             "cable friction due to pretension, in the unit of load")}};
}

}  // namespace

Effect capstan_friction(JointKind kind) {
  Effect effect;
  effect.name = "capstan_friction";
  effect.place = ChainPlace::pins;
  effect.rank = 1;
  effect.signature = "hysteresis that grows with load and wrap, with a transition after each reversal";
  effect.separating_run = "run at two loads: hysteresis by friction grows with the load, by backlash it does not";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {};
  if (kind == JointKind::ratio) {
    effect.signature =
        "hysteresis in the compliance: it grows with the load, builds up gradually after each reversal, and "
        "holds the joint in place when the load is removed";
    effect.needs = {.load = true};
    effect.parameters = friction_of_cable();
    effect.starts = {{0.1, 0}, {0.3, 0}};
    return effect;
  }
  effect.needs = {.pins = true};
  effect.parameters = {
      {.name = "mu",
       .number = [](Imperfections& at) -> double& { return at.pins.friction; },
       .least = -1,
       .most = 2,
       .step = 5e-3,
       .prior = 0.15,  // steel or HMPE over metal pins: 0.05 to 0.4, declared 0.1 to 0.2
       .shown = total_friction,
       .key = key::plain("friction", "", -2, 2, "added to guides.friction; for idlers, to guides.bearing_friction"),
       .merge_rule = MergeRule::add}};
  effect.starts = {{0.1}, {0.4}};
  return effect;
}

}  // namespace fusee
