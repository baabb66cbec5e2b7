#include "mechanism/effect.h"

namespace fusee {

Effect gravity(JointKind) {
  Effect effect;
  effect.name = "gravity";
  effect.place = ChainPlace::joint;
  effect.rank = 2;
  effect.signature = "a load that varies with the joint angle and acts through the tendons' stretch";
  effect.separating_run = "repeat one run with the joint lying on its side";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {{.name = "cos_Nmm",
                        .number = [](Imperfections& at) -> double& { return at.joint.weight.cos; },
                        .least = -1e6,
                        .most = 1e6,
                        .step = 1,
                        .prior = 500,  // half a kilogram at 100 mm
                        .shown = shown::as_is,
                        .key = key::plain("gravity_cos_Nmm", "Nmm", -1e+07, 1e+07, "torque against +theta: cos theta"),
                        .merge_rule = MergeRule::add},
                       {.name = "sin_Nmm",
                        .number = [](Imperfections& at) -> double& { return at.joint.weight.sin; },
                        .least = -1e6,
                        .most = 1e6,
                        .step = 1,
                        .prior = 500,  // half a kilogram at 100 mm
                        .shown = shown::as_is,
                        .key = key::plain("gravity_sin_Nmm", "Nmm", -1e+07, 1e+07, "torque against +theta: sin theta"),
                        .merge_rule = MergeRule::add}};
  return effect;
}

}  // namespace fusee
