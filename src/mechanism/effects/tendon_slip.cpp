#include "mechanism/effect.h"

namespace fusee {
namespace {

EffectParameter slip_time() {
  return {.name = "time_s",
          .number = [](Imperfections& at) -> double& { return at.tendon.slip_time; },
          .least = -1e12,
          .most = 1e12,
          .step = 1,
          .shown = shown::as_is,
          .key = key::plain("slip_time_s", "s", -1e+12, 1e+12, "time of the slip, counted over the runs in sequence"),
          .searched = true};
}

/// A release of tendon 1 moves the joint towards +θ, a release of tendon 2 towards −θ.
EffectParameter released_length() {
  return {.name = "released_mm",
          .number = [](Imperfections& at) -> double& { return at.tendon.slip; },
          .least = -20,
          .most = 20,
          .step = 1e-2,
          .prior = 1,  // a knot that draws tight
          .shown = shown::as_is,
          .key = key::plain("slip_mm", "mm", -1000, 1000,
                            "length released by the anchor of tendon 1 (tendon 2 if negative)")};
}

/// Parameter for a joint declared by a ratio.
EffectParameter rotation_step() {
  return {.name = "step_deg",
          .number = [](Imperfections& at) -> double& { return at.ratio_joint.step; },
          .least = -0.5,
          .most = 0.5,
          .step = 1e-3,
          .prior = radians(1.0),  // a knot that draws tight, on a pulley of some centimetres
          .shown = shown::in_degrees,
          .key = key::in_degrees("step_deg", -360, 360, "joint declared by a ratio: rotation at slip_time_s")};
}

}  // namespace

Effect tendon_slip(JointKind kind) {
  Effect effect;
  effect.name = "tendon_slip";
  effect.place = ChainPlace::tendon;
  effect.rank = 4;
  effect.signature = "one permanent step in time, at high tension";
  effect.separating_run = "mark the tendon where it enters the pulley and check the mark after a loaded run";
  effect.correctable_by = CorrectableBy::nothing;
  effect.needs = {.time = true};
  effect.starts_in_time = true;
  effect.parameters = {kind == JointKind::ratio ? rotation_step() : released_length(), slip_time()};
  return effect;
}

}  // namespace fusee
