#include "mechanism/effect.h"

namespace fusee {
namespace {

/// Parameters for a joint declared by a ratio. Both signs are allowed, since the log's load has a sign.
std::vector<EffectParameter> straightening_of_ratio() {
  return {{.name = "straightened_deg",
           .number = [](Imperfections& at) -> double& { return at.ratio_joint.waves.most; },
           .least = -0.5,
           .most = 0.5,
           .step = 2e-3,
           .prior = radians(3.0),  // a cable of 0.5 m on a lever of 5 mm, 0.05 % longer than straight
           .shown = shown::in_degrees,
           .key = key::in_degrees("straightened_deg", -360, 360,
                                  "joint declared by a ratio: rotation until the cable is straight")},
          {.name = "straightened_per_load",
           .number = [](Imperfections& at) -> double& { return at.ratio_joint.waves.rate; },
           .least = 0,
           .most = 1e6,
           .step = 1e-2,
           .prior = 4,  // at the largest load: four fifths of the rotation
           .prior_unit = PriorUnit::at_largest_load,
           .shown = shown::as_is,
           .key = key::plain("straightened_per_load", "", 0, 1e6,
                             "rate of straightening: half of it is reached at a load of 1/straightened_per_load")}};
}

std::vector<EffectParameter> straightening_of_tendons() {
  return {{.name = "straightened_mm",
           .number = [](Imperfections& at) -> double& { return at.tendon.waves.most; },
           .least = 0,
           .most = 10,
           .step = 5e-3,
           .prior = 0.3,  // 0.1 % of 300 mm; a knot that draws tight
           .shown = shown::as_is,
           .key = key::plain("straightened_mm", "mm", 0, 1000,
                             "elongation of each tendon until its waves are straightened")},
          {.name = "straightened_per_N",
           .number = [](Imperfections& at) -> double& { return at.tendon.waves.rate; },
           .least = 0,
           .most = 100,
           .step = 5e-3,
           .prior = 0.2,  // half of it at 5 N, a usual pretension
           .shown = shown::as_is,
           .key = key::plain("straightened_per_N", "per_N", 0, 1000,
                             "rate of straightening: half of it is reached at a tension of 1/straightened_per_N")}};
}

}  // namespace

Effect tendon_stiffening(JointKind kind) {
  Effect effect;
  effect.name = "tendon_stiffening";
  effect.place = ChainPlace::tendon;
  effect.rank = 6;
  effect.signature = "compliant under a small load and stiffer under a large one; independent of direction";
  effect.separating_run = "run the same strokes at a tenth, a quarter, half and the full load";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.load = true};
  if (kind == JointKind::tendons) {
    // With pretensioned tendons it is equivalent to tendon_stretch, and no measured joint has required it.
    effect.is_tested = false;
    effect.parameters = straightening_of_tendons();
    return effect;
  }
  effect.parameters = straightening_of_ratio();
  for (const double rate : {0.02, 0.3, 5.0, 80.0}) effect.starts.push_back({radians(0.1), rate});
  return effect;
}

}  // namespace fusee
