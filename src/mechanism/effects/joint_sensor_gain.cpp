#include <cmath>

#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

// Uncertainty of the gain from three readings, each uncertain by 0.1 degrees, at both ends of a range of 45 degrees.
constexpr double k_protractor = 0.002;

std::vector<ManualReading> gain_by_protractor(const DeclaredMechanism& declared) {
  return hand_reading_in(declared.prior.gain_percent, 0.01);
}

/// Relative excess of the reading between both ends of the range. The sensor's harmonics contribute to it; their
/// constant terms cancel.
double excess_of_reading(const Imperfections& joint, const Mechanism& declared) {
  const JointSensorError& error = joint.sensor;
  const double low = declared.joint.theta_min, high = declared.joint.theta_max;
  if (!(high > low)) return error.gain;
  const auto wave = [](double theta, double sin_part, double cos_part) {
    return sin_part * elementary::sin(theta) + cos_part * elementary::cos(theta);
  };
  const auto harmonics = [&](double theta) {
    return wave(theta, error.eccentricity_sin, error.eccentricity_cos) +
           wave(error.wave_order * theta, error.wave_sin, error.wave_cos);
  };
  return error.gain + (harmonics(high) - harmonics(low)) / (high - low);
}

}  // namespace

Effect joint_sensor_gain(JointKind) {
  Effect effect;
  effect.name = "joint_sensor_gain";
  effect.place = ChainPlace::joint_sensor;
  effect.rank = 2;
  effect.signature = "proportional to theta, independent of direction and load";
  effect.separating_run = "hold the joint at both ends of its range against a protractor";
  effect.needs = {};
  effect.parameters = {
      {.name = "gain_percent",
       .number = [](Imperfections& at) -> double& { return at.sensor.gain; },
       .least = -0.3,
       .most = 0.3,
       .step = 1e-3,
       .prior = 0.02,  // potentiometers and linear Hall sensors; encoders have none
       .shown = shown::in_percent,
       .key = key::in_percent("gain_percent", -99, 1000, "relative excess of the joint sensor's reading"),
       .by_hand = {"hold the joint at both ends of its range against a protractor and enter the excess of the sensor's "
                   "reading between them, in percent, as prior.gain_percent",
                   k_protractor, gain_by_protractor, "prior.gain_percent", HandTool::protractor, excess_of_reading},
       .sign = {"the sensor reads too little", "the sensor reads too much"}}};
  return effect;
}

}  // namespace fusee
