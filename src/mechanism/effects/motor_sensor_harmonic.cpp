#include "mechanism/effect.h"
#include "mechanism/effects/sensor_wave.h"

namespace fusee {

Effect motor_sensor_harmonic(JointKind) {
  Effect effect;
  effect.name = "motor_sensor_harmonic";
  effect.place = ChainPlace::motor_sensor;
  effect.rank = 3;
  effect.signature = "two, three or four times per turn of the motor sensor, independent of direction and load";
  effect.separating_run =
      "turn the motor's encoder on its shaft by an eighth of a turn and repeat the slow unloaded run";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.long_stroke = true};
  effect.parameters = {
      wave_part(
          "sin_deg", [](Imperfections& at) -> double& { return at.motor.wave_sin; },
          key::in_degrees("motor_wave_sin_deg", -360, 360,
                          "n times a turn of the motor sensor: coefficient of sin n alpha")),
      wave_part(
          "cos_deg", [](Imperfections& at) -> double& { return at.motor.wave_cos; },
          key::in_degrees("motor_wave_cos_deg", -360, 360,
                          "n times a turn of the motor sensor: coefficient of cos n alpha - 1")),
      wave_order([](Imperfections& at) -> double& { return at.motor.wave_order; }, "motor_wave_harmonic")};
  effect.starts = wave_starts();
  return effect;
}

}  // namespace fusee
