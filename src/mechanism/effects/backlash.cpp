#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

constexpr double k_uncertainty = radians(0.05);  // of the mean of three readings of both ends of the play, by feel

std::vector<ManualReading> play_by_hand(const DeclaredMechanism& declared) {
  return hand_reading_in(declared.prior.backlash_deg, radians(1.0));
}

}  // namespace

Effect backlash(JointKind) {
  Effect effect;
  effect.name = "backlash";
  effect.place = ChainPlace::shaft;
  effect.rank = 1;
  effect.signature =
      "rectangular hysteresis of constant width in alpha, independent of load and speed, over a distance after a "
      "reversal";
  effect.separating_run = "repeat one run at a tenth of its speed and one at another load: backlash does not change";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {};
  effect.parameters = {
      {.name = "width_deg",
       .number = [](Imperfections& at) -> double& { return at.shaft.backlash; },
       .least = 0,
       .most = 0.5,
       .step = 2e-3,
       .prior = radians(2.0),  // hobby servos and printed couplings; 0.3 to 5 degrees are common
       .shown = shown::in_degrees,
       .key = key::in_degrees("backlash_deg", 0, 360,
                              "play of alpha, full width; corrected by compensation.csv, not by a pulley"),
       .by_hand = {
           "hold the pulley, turn the motor to and fro until it just begins to push, and enter the travel of its "
           "sensor as prior.backlash_deg",
           k_uncertainty, play_by_hand, "prior.backlash_deg", HandTool::motor_sensor}}};
  effect.starts = {{radians(0.3)}, {radians(1.5)}, {radians(5.0)}};
  return effect;
}

}  // namespace fusee
