#include "mechanism/effect.h"

namespace fusee {

// A joint declared by a ratio has one compliance, so dry friction equals play of constant width: backlash covers it.
Effect joint_friction(JointKind) {
  Effect effect;
  effect.name = "joint_friction";
  effect.place = ChainPlace::joint;
  effect.rank = 3;
  effect.signature =
      "hysteresis proportional to the tendons' compliance, independent of load; the joint sticks after a reversal";
  effect.separating_run =
      "repeat one run with twice the pretension or a stiffer tendon: hysteresis by friction shrinks, by backlash it "
      "does not";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "torque_Nmm",
       .number = [](Imperfections& at) -> double& { return at.joint.friction; },
       .least = 0,
       .most = 1e5,
       .step = 0.5,
       .prior = 30,  // 50 N on a plain bearing of 3 mm radius at 0.2; a seal, a cable over the joint
       .shown = shown::as_is,
       .key = key::plain("joint_friction_Nmm", "Nmm", 0, 1e+07, "dry friction of the joint's bearing")}};
  effect.starts = {{10}, {100}, {1000}};
  effect.sticks = true;
  return effect;
}

}  // namespace fusee
