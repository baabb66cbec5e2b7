#include "mechanism/effects/effect.h"

namespace fusee {

Effect motor_sensor_eccentricity(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "motor_sensor_eccentricity";
  effect.place = "motor sensor";
  effect.signature = "once per turn of the motor sensor, whichever way and load";
  effect.correctable_by = "table";
  effect.separating_run = "turn the motor's encoder on its shaft by a quarter turn and repeat the slow unloaded run";
  effect.parameters = {{"sin_deg", &Imperfections::motor_eccentricity_sin, -0.2, 0.2, 1e-3, shown::in_degrees},
                       {"cos_deg", &Imperfections::motor_eccentricity_cos, -0.2, 0.2, 1e-3, shown::in_degrees}};
  effect.applies = applies::to_full_turn;
  return effect;
}

}  // namespace fusee
