#include "mechanism/effect.h"

namespace fusee {

// The drum's centre moves round the joint's axis with the link: a harmonic of one turn of θ in the path of the tendons
// on the drum and, through their arms, in the torque.
Effect drum_runout(JointKind) {
  Effect effect;
  effect.name = "drum_runout";
  effect.place = ChainPlace::joint;
  effect.rank = 5;
  effect.signature = "once per turn of the joint where tendons lie on its drum, independent of direction and load";
  effect.separating_run =
      "hold a dial gauge against the drum and turn the joint; or turn the joint's encoder on its axis by a quarter "
      "turn";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true, .drum = true};
  effect.parameters = {
      {.name = "across_mm",
       .number = [](Imperfections& at) -> double& { return at.joint.drum.across; },
       .least = -5,
       .most = 5,
       .step = 2e-3,
       .prior = 0.2,  // a printed bore on a bearing
       .shown = shown::as_is,
       .key = key::plain("drum_across_mm", "mm", -100, 100,
                         "eccentricity of the drum about the joint's axis, in the link at home: to the right"),
       .merge_rule = MergeRule::add},
      {.name = "along_mm",
       .number = [](Imperfections& at) -> double& { return at.joint.drum.along; },
       .least = -5,
       .most = 5,
       .step = 2e-3,
       .prior = 0.2,
       .shown = shown::as_is,
       .key = key::plain("drum_along_mm", "mm", -100, 100, "eccentricity of the drum along OC"),
       .merge_rule = MergeRule::add}};
  return effect;
}

}  // namespace fusee
