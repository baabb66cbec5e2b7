/// \file
/// Both ends of the chain: what the motor's sensor hides of the shaft, the play behind it, and what the joint's sensor
/// shows.
#pragma once

#include <vector>

#include "fusee/joint/bench_log.h"
#include "fusee/mechanism/imperfections.h"

namespace fusee {

/// What a sensor errs by, seen after it was turned by `angle` and its zero set again.
MotorSensorError turned(MotorSensorError error, double angle);
JointSensorError turned(JointSensorError error, double angle);

/// Where the shaft stands when the sensor shows `alpha`, rad.
double shaft_angle(double alpha, const MotorSensorError& error);

/// The play operator: follows its input at a distance of half the width, and stands still in between.
class Play {
 public:
  explicit Play(double input) : output_(input) {}
  double to(double input, double width);

 private:
  double output_;
};

/// θ of a run as the joint's sensor shows it, rad.
std::vector<double> sensed(const BenchRun& run, std::vector<double> theta, const JointSensorError& error);

}  // namespace fusee
