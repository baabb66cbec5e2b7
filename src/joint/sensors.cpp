#include "joint/sensors.h"

#include <algorithm>
#include <cmath>

namespace fusee {
namespace {

/// θ at the time `lag` earlier, straight between samples. Before the first sample the joint stood still.
std::vector<double> delayed(const BenchRun& run, const std::vector<double>& theta, double lag) {
  std::vector<double> late(theta.size());
  std::size_t j = 0;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const double time = run.rows[i].time - lag;
    while (j + 1 < theta.size() && run.rows[j + 1].time <= time) ++j;
    const double from = run.rows[j].time;
    const double step = j + 1 < theta.size() ? run.rows[j + 1].time - from : 0.0;
    const double share = step > 0 ? std::clamp((time - from) / step, 0.0, 1.0) : 0.0;
    late[i] = share > 0 ? theta[j] + share * (theta[j + 1] - theta[j]) : theta[j];
  }
  return late;
}

}  // namespace

double shaft_angle(double alpha, const MotorSensorError& error) {
  if (error.eccentricity_sin == 0 && error.eccentricity_cos == 0) return alpha + error.offset;
  return alpha + error.offset + error.eccentricity_sin * std::sin(alpha) +
         error.eccentricity_cos * (std::cos(alpha) - 1.0);
}

double Play::to(double input) {
  output_ = std::clamp(output_, input - half_, input + half_);
  return output_;
}

std::vector<double> sensed(const BenchRun& run, std::vector<double> theta, const JointSensorError& error) {
  if (error.lag != 0) theta = delayed(run, theta, error.lag);
  for (double& angle : theta) {
    const double true_angle = angle;
    angle = error.zero + (1.0 + error.gain) * true_angle + error.eccentricity_sin * std::sin(true_angle) +
            error.eccentricity_cos * (std::cos(true_angle) - 1.0);
  }
  return theta;
}

}  // namespace fusee
