#include "mechanism/effect.h"

namespace fusee {

Effect thermal_expansion(JointKind kind) {
  Effect effect;
  effect.name = "thermal_expansion";
  effect.place = ChainPlace::tendon;
  effect.rank = 5;
  effect.signature = "follows the temperature";
  effect.separating_run = "log temperature_C over a warm-up without motion";
  effect.correctable_by = CorrectableBy::nothing;
  effect.needs = {.temperature = true};
  if (kind == JointKind::ratio) {
    effect.parameters = {
        {.name = "per_K_deg",
         .number = [](Imperfections& at) -> double& { return at.ratio_joint.warmth; },
         .least = -0.05,
         .most = 0.05,
         .step = 1e-4,
         .prior = radians(0.02),  // 100 ppm over a metre of tendon on a lever of 300 mm
         .shown = shown::in_degrees,
         .key = key::in_degrees("warmth_deg", -360, 360, "joint declared by a ratio: rotation per kelvin")}};
    return effect;
  }
  effect.parameters = {{.name = "tendon1_ppm_per_K",
                        .number = [](Imperfections& at) -> double& { return at.tendon.thermal1; },
                        .least = -5e-3,
                        .most = 5e-3,
                        .step = 2e-6,
                        .prior = 5e-5,  // steel 12, HMPE -12, nylon 80 ppm, minus that of the frame
                        .shown = shown::in_ppm,
                        .key = key::in_ppm("thermal1_ppm_per_K", "thermal expansion of unloaded tendon 1")},
                       {.name = "tendon2_ppm_per_K",
                        .number = [](Imperfections& at) -> double& { return at.tendon.thermal2; },
                        .least = -5e-3,
                        .most = 5e-3,
                        .step = 2e-6,
                        .prior = 5e-5,  // steel 12, HMPE -12, nylon 80 ppm, minus that of the frame
                        .shown = shown::in_ppm,
                        .key = key::in_ppm("thermal2_ppm_per_K", "thermal expansion of unloaded tendon 2")}};
  return effect;
}

}  // namespace fusee
