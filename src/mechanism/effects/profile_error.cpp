#include <cmath>

#include "mechanism/effect.h"

namespace fusee {
namespace {

double as_written(double order) { return order; }

double size(const OutlineError& outline) { return elementary::hypot(outline.wave_sin, outline.wave_cos); }

/// Adds harmonics of equal order. Of two harmonics of different order, only the larger one is kept, because
/// OutlineError holds one.
void larger_wave(const Imperfections& before, Imperfections& joint) {
  const OutlineError& first = before.pulley.outline;
  OutlineError& total = joint.pulley.outline;
  if (size(total) == 0 || (first.wave_order != total.wave_order && size(first) > size(total))) {
    total.wave_sin = first.wave_sin;
    total.wave_cos = first.wave_cos;
    total.wave_order = first.wave_order;
  } else if (first.wave_order == total.wave_order) {
    total.wave_sin += first.wave_sin;
    total.wave_cos += first.wave_cos;
  }
}

}  // namespace

Effect profile_error(JointKind) {
  Effect effect;
  effect.name = "profile_error";
  effect.place = ChainPlace::pulley;
  effect.rank = 4;
  effect.signature = "twice or three times per turn of the pulley, independent of direction and load";
  effect.separating_run = "turn the pulley on its shaft by an eighth of a turn and repeat the slow unloaded run";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true, .long_stroke = true};
  effect.merge = larger_wave;
  effect.parameters = {
      {.name = "sin_mm",
       .number = [](Imperfections& at) -> double& { return at.pulley.outline.wave_sin; },
       .least = -2,
       .most = 2,
       .step = 2e-3,
       .prior = 0.2,  // layers, seams and three-jaw chucks: 0.05 to 0.3 mm
       .shown = shown::as_is,
       .key = key::plain("profile_sin_mm", "mm", -100, 100,
                         "harmonic of the made curves, outwards along the normal psi: coefficient of sin n psi"),
       .merge_rule = MergeRule::add},
      {.name = "cos_mm",
       .number = [](Imperfections& at) -> double& { return at.pulley.outline.wave_cos; },
       .least = -2,
       .most = 2,
       .step = 2e-3,
       .prior = 0.2,  // layers, seams and three-jaw chucks: 0.05 to 0.3 mm
       .shown = shown::as_is,
       .key = key::plain("profile_cos_mm", "mm", -100, 100, "harmonic of the made curves: coefficient of cos n psi"),
       .merge_rule = MergeRule::add},
      {.name = "harmonic",
       .number = [](Imperfections& at) -> double& { return at.pulley.outline.wave_order; },
       .least = 2,
       .most = 3,
       .step = 1,
       .shown = shown::as_is,
       .key = {"profile_harmonic", "", "order n of the harmonic", 1, 100, as_written, as_written, "2"},
       .merge_rule = MergeRule::add,
       .searched = true}};
  effect.starts = {{0, 0, 2}, {0, 0, 3}};
  return effect;
}

}  // namespace fusee
