#include "fusee/mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

constexpr double k_feel = radians(0.05);  // where a hand feels both ends of the play, three times

std::vector<CaliperReading> play_by_hand(const DeclaredMechanism& declared) {
  return hand_reading_in(declared.prior.backlash, radians(1.0));
}

}  // namespace

Effect backlash(JointKind) {
  Effect effect;
  effect.name = "backlash";
  effect.place = ChainPlace::shaft;
  effect.rank = 1;
  effect.signature =
      "a square loop of constant width in alpha, whatever load and speed; it decays over distance after a reversal";
  effect.separating_run =
      "repeat one run at a tenth of its speed and one at another load: backlash changes with neither";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {};
  effect.parameters = {
      {.name = "width_deg",
       .number = [](Imperfections& at) -> double& { return at.shaft.backlash; },
       .least = 0,
       .most = 0.5,
       .step = 2e-3,
       .prior = radians(2.0),  // of hobby servos and printed couplings; 0.3 to 5 degrees are common
       .shown = shown::in_degrees,
       .key = key::in_degrees("backlash_deg", 0, 360,
                              "play of alpha, full width; no pulley takes it out, compensation.csv does"),
       .by_hand = {"hold the pulley, turn the motor to and fro until it just begins to push, and write how far its "
                   "sensor moves between as [prior] backlash_deg",
                   k_feel, play_by_hand, "prior.backlash_deg", HandTool::motor_sensor}}};
  effect.starts = {{radians(0.3)}, {radians(1.5)}, {radians(5.0)}};
  return effect;
}

}  // namespace fusee
