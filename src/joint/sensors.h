/// \file
/// Sensors at both ends of the chain, and the play behind the motor's sensor.
#pragma once

#include <vector>

#include "fusee/joint.h"
#include "fusee/mechanism.h"

namespace fusee::joint {

/// The errors of a sensor after it was turned by `angle` and its zero set again.
MotorSensorError turned(MotorSensorError error, double angle);
JointSensorError turned(JointSensorError error, double angle);

/// Angle of the shaft when the sensor reads `alpha`, rad.
double shaft_angle(double alpha, const MotorSensorError& error);

/// The play operator: follows its input at half the width, and rests in between.
class Play {
 public:
  explicit Play(double input) : output_(input) {}
  /// The output after the input moves to `input`, with play of the full `width`. rad
  double to(double input, double width);

 private:
  double output_;
};

/// Readings of the joint sensor for θ of a run, rad.
std::vector<double> sensed(const BenchRun& run, std::vector<double> theta, const JointSensorError& error);

}  // namespace fusee::joint
