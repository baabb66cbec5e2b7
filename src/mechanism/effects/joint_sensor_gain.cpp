#include "fusee/mechanism/effect.h"

namespace fusee {
namespace {

constexpr double k_square = 0.005;  // of the gain, by a square

}  // namespace

Effect joint_sensor_gain(JointKind) {
  Effect effect;
  effect.name = "joint_sensor_gain";
  effect.place = ChainPlace::joint_sensor;
  effect.rank = 2;
  effect.signature = "in proportion to theta, whichever way and load";
  effect.separating_run = "read the joint's sensor against a square at two angles";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {};
  effect.parameters = {
      {.name = "gain_percent",
       .number = [](Imperfections& at) -> double& { return at.sensor.gain; },
       .least = -0.3,
       .most = 0.3,
       .step = 1e-3,
       .prior = 0.02,  // potentiometers and linear Hall sensors; an encoder has none
       .shown = shown::in_percent,
       .key = key::in_percent("gain_percent", -99, 1000, "by how much the joint sensor shows too much"),
       .by_hand = {"read the joint's sensor against a square at two angles", k_square},
       .sign = {"it shows too little", "it shows too much"}}};
  return effect;
}

}  // namespace fusee
