#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

constexpr double k_pulley_mark = radians(0.2);  // uncertainty of the mean of three settings of a pulley to its mark

std::vector<ManualReading> motor_offset_by_mark(const DeclaredMechanism& declared) {
  return hand_reading_in(declared.prior.motor_offset_deg, radians(1.0));
}

}  // namespace

Effect motor_offset(JointKind) {
  Effect effect;
  effect.name = "motor_offset";
  effect.place = ChainPlace::motor_sensor;
  effect.rank = 1;
  effect.signature = "like a zero offset of the joint, proportional to the slope of the transmission";
  effect.separating_run = "drive the joint to a mechanical stop or mark at home and read both sensors there";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "offset_deg",
       .number = [](Imperfections& at) -> double& { return at.motor.offset; },
       .least = -0.35,
       .most = 0.35,
       .step = 1e-3,
       .prior = radians(2.0),  // a spline tooth is 14 degrees, a mark by eye 1 to 2
       .shown = shown::in_degrees,
       .key =
           key::in_degrees("motor_offset_deg", -360, 360, "angle of the shaft minus the reading of the motor sensor"),
       .by_hand = {"turn the motor until the pulley's mark is at home and enter by how much the motor's "
                   "sensor reads too low there as prior.motor_offset_deg",
                   k_pulley_mark, motor_offset_by_mark, "prior.motor_offset_deg", HandTool::mark}}};
  return effect;
}

}  // namespace fusee
