#include "mechanism/effects/effect.h"

namespace fusee {

Effect joint_sensor_eccentricity(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "joint_sensor_eccentricity";
  effect.place = "joint sensor";
  effect.signature = "once per turn of the joint sensor, whichever way and load";
  effect.correctable_by = "table";
  effect.separating_run = "turn the joint's encoder on its axis by a quarter turn and repeat the slow unloaded run";
  effect.parameters = {{"sin_deg", &Imperfections::joint_eccentricity_sin, -0.3, 0.3, 2e-3, shown::in_degrees},
                       {"cos_deg", &Imperfections::joint_eccentricity_cos, -0.5, 0.5, 5e-3, shown::in_degrees}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
