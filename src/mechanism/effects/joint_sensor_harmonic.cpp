#include "mechanism/effect.h"
#include "mechanism/effects/sensor_wave.h"

namespace fusee {

Effect joint_sensor_harmonic(JointKind) {
  Effect effect;
  effect.name = "joint_sensor_harmonic";
  effect.place = ChainPlace::joint_sensor;
  effect.rank = 4;
  effect.signature = "two, three or four times per turn of the joint sensor, independent of direction and load";
  effect.separating_run =
      "turn the joint's encoder on its axis by an eighth of a turn and repeat the slow unloaded run";
  effect.needs = {.tendons = true};
  effect.parameters = {
      wave_part(
          "sin_deg", [](Imperfections& at) -> double& { return at.sensor.wave_sin; },
          key::in_degrees("joint_wave_sin_deg", -360, 360,
                          "n times a turn of the joint sensor: coefficient of sin n theta")),
      wave_part(
          "cos_deg", [](Imperfections& at) -> double& { return at.sensor.wave_cos; },
          key::in_degrees("joint_wave_cos_deg", -360, 360,
                          "n times a turn of the joint sensor: coefficient of cos n theta - 1")),
      wave_order([](Imperfections& at) -> double& { return at.sensor.wave_order; }, "joint_wave_harmonic")};
  effect.starts = wave_starts();
  return effect;
}

}  // namespace fusee
