#include "mechanism/effect.h"

namespace fusee {

Effect motor_sensor_eccentricity(JointKind) {
  Effect effect;
  effect.name = "motor_sensor_eccentricity";
  effect.place = ChainPlace::motor_sensor;
  effect.rank = 2;
  effect.signature = "once per turn of the motor sensor, independent of direction and load";
  effect.separating_run = "turn the motor's encoder on its shaft by a quarter turn and repeat the slow unloaded run";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.long_stroke = true};
  effect.parameters = {{.name = "sin_deg",
                        .number = [](Imperfections& at) -> double& { return at.motor.eccentricity_sin; },
                        .least = -0.2,
                        .most = 0.2,
                        .step = 1e-3,
                        .prior = radians(1.0),  // 0.1 mm on a ring of 10 mm radius: 0.6 degrees
                        .shown = shown::in_degrees,
                        .key = key::in_degrees("motor_eccentricity_sin_deg", -360, 360,
                                               "once a turn of the motor sensor: coefficient of sin alpha")},
                       {.name = "cos_deg",
                        .number = [](Imperfections& at) -> double& { return at.motor.eccentricity_cos; },
                        .least = -0.2,
                        .most = 0.2,
                        .step = 1e-3,
                        .prior = radians(1.0),  // 0.1 mm on a ring of 10 mm radius: 0.6 degrees
                        .shown = shown::in_degrees,
                        .key = key::in_degrees("motor_eccentricity_cos_deg", -360, 360,
                                               "once a turn of the motor sensor: coefficient of cos alpha - 1")}};
  return effect;
}

}  // namespace fusee
