#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

constexpr double k_mark = radians(0.1);  // uncertainty of the mean of three settings of a joint to a mark

std::vector<ManualReading> zero_by_mark(const DeclaredMechanism& declared) {
  return hand_reading_in(declared.prior.zero_deg, radians(1.0));
}

}  // namespace

Effect zero_offset(JointKind) {
  Effect effect;
  effect.name = "zero_offset";
  effect.place = ChainPlace::joint_sensor;
  effect.rank = 1;
  effect.signature = "one constant";
  effect.separating_run = "drive the joint to a mechanical stop or mark at home and read both sensors there";
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "offset_deg",
       .number = [](Imperfections& at) -> double& { return at.sensor.zero; },
       .least = -0.35,
       .most = 0.35,
       .step = 1e-3,
       .prior = radians(2.0),  // a magnet glued on, a mark by eye
       .shown = shown::in_degrees,
       .key = key::in_degrees("zero_deg", -360, 360, "reading of the joint sensor at theta = 0"),
       .by_hand = {"drive the joint to a mark at home and enter its sensor's reading there as prior.zero_deg", k_mark,
                   zero_by_mark, "prior.zero_deg", HandTool::mark}}};
  return effect;
}

}  // namespace fusee
