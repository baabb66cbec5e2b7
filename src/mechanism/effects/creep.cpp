#include "mechanism/effect.h"

namespace fusee {

Effect creep(JointKind kind) {
  Effect effect;
  effect.name = "creep";
  effect.place = ChainPlace::tendon;
  effect.rank = 3;
  effect.signature = "grows with the logarithm of time at constant load";
  effect.separating_run = "hold one loaded position for ten minutes and log it";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.time = true};
  if (kind == JointKind::ratio) {
    effect.needs.load = true;  // with tendons, pretension is such a load
    effect.parameters = {
        {.name = "per_decade_deg_per_load",
         .number = [](Imperfections& at) -> double& { return at.ratio_joint.drift; },
         .least = -1e6,
         .most = 1e6,
         .step = 1e-4,
         .prior = radians(0.5),  // at the largest load: a tenth of its elastic rotation
         .prior_unit = PriorUnit::at_largest_load,
         .shown = shown::in_degrees,
         .key = key::in_degrees("drift_deg", -360, 360,
                                "joint declared by a ratio: rotation per unit of load in every decade of seconds")}};
    return effect;
  }
  effect.parameters = {
      {.name = "compliance_percent_per_decade",
       .number = [](Imperfections& at) -> double& { return at.tendon.creep; },
       .least = 0,
       .most = 10,
       .step = 2e-3,
       .prior = 0.05,  // steel below 0.01, braided HMPE 0.02 to 0.1, nylon more
       .shown = shown::in_percent,
       .key = key::plain("creep_per_decade", "", -0.5, 100,
                         "compliance added in every decade of seconds, relative to the first decade")}};
  return effect;
}

}  // namespace fusee
