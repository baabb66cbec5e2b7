#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

constexpr double k_dial_on_hub = 0.03;  // uncertainty of a dial gauge's reading on a printed hub, mm

std::vector<ManualReading> runout_x_by_dial(const DeclaredMechanism& declared) {
  return hand_reading_in(declared.prior.runout_x, 1.0);
}
std::vector<ManualReading> runout_y_by_dial(const DeclaredMechanism& declared) {
  return hand_reading_in(declared.prior.runout_y, 1.0);
}

}  // namespace

Effect pulley_runout(JointKind) {
  Effect effect;
  effect.name = "pulley_runout";
  effect.place = ChainPlace::pulley;
  effect.rank = 3;
  effect.signature = "once per turn of the pulley, independent of direction and load";
  effect.separating_run = "turn the pulley on its shaft by a quarter turn and repeat the slow unloaded run";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {
      {.name = "x_mm",
       .number = [](Imperfections& at) -> double& { return at.pulley.outline.runout_x; },
       .least = -2,
       .most = 2,
       .step = 2e-3,
       .prior = 0.3,  // a printed bore on a shaft with play and a set screw
       .shown = shown::as_is,
       .key = key::plain("runout_x_mm", "mm", -100, 100, "eccentricity of the made curves at home, to the right"),
       .merge_rule = MergeRule::add,
       .by_hand = {"hold a dial gauge against the hub, turn the pulley once, and enter how far the hub's centre is to "
                   "the right of its axis at home as prior.runout_x_mm",
                   k_dial_on_hub, runout_x_by_dial, "prior.runout_x_mm", HandTool::dial_gauge}},
      {.name = "y_mm",
       .number = [](Imperfections& at) -> double& { return at.pulley.outline.runout_y; },
       .least = -2,
       .most = 2,
       .step = 2e-3,
       .prior = 0.3,  // a printed bore on a shaft with play and a set screw
       .shown = shown::as_is,
       .key = key::plain("runout_y_mm", "mm", -100, 100, "eccentricity of the made curves at home, upwards"),
       .merge_rule = MergeRule::add,
       .by_hand = {
           "hold a dial gauge against the hub, turn the pulley once, and enter how far the hub's centre is above "
           "its axis at home as prior.runout_y_mm",
           k_dial_on_hub, runout_y_by_dial, "prior.runout_y_mm", HandTool::dial_gauge}}};
  return effect;
}

}  // namespace fusee
