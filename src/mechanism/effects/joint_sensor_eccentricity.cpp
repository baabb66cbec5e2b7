#include "mechanism/effect.h"

namespace fusee {

Effect joint_sensor_eccentricity(JointKind) {
  Effect effect;
  effect.name = "joint_sensor_eccentricity";
  effect.place = ChainPlace::joint_sensor;
  effect.rank = 3;
  effect.signature = "once per turn of the joint sensor, independent of direction and load";
  effect.separating_run = "turn the joint's encoder on its axis by a quarter turn and repeat the slow unloaded run";
  effect.needs = {.tendons = true};
  effect.parameters = {{.name = "sin_deg",
                        .number = [](Imperfections& at) -> double& { return at.sensor.eccentricity_sin; },
                        .least = -0.3,
                        .most = 0.3,
                        .step = 2e-3,
                        .prior = radians(1.0),  // 0.1 mm on a ring of 10 mm radius: 0.6 degrees
                        .shown = shown::in_degrees,
                        .key = key::in_degrees("joint_eccentricity_sin_deg", -360, 360,
                                               "once a turn of the joint sensor: coefficient of sin theta")},
                       {.name = "cos_deg",
                        .number = [](Imperfections& at) -> double& { return at.sensor.eccentricity_cos; },
                        .least = -0.5,
                        .most = 0.5,
                        .step = 5e-3,
                        .prior = radians(1.0),  // 0.1 mm on a ring of 10 mm radius: 0.6 degrees
                        .shown = shown::in_degrees,
                        .key = key::in_degrees("joint_eccentricity_cos_deg", -360, 360,
                                               "once a turn of the joint sensor: coefficient of cos theta - 1")}};
  return effect;
}

}  // namespace fusee
