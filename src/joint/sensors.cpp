#include "joint/sensors.h"

#include <algorithm>
#include <cmath>

namespace fusee::joint {
namespace {

/// Motion below which a motor counts as dwelling, as a fraction of the neighbouring motion.
constexpr double k_dwell_tolerance = 0.02;

/// True when α moved from one dwell to another between the rows i − 1 and i. The time of arrival is then unknown.
/// Row `i` counts as settled, since logs from point to point are read after settling.
bool has_unknown_arrival(const BenchRun& run, std::size_t i) {
  if (i == 0 || i + 1 >= run.rows.size()) return false;
  const auto travel_to = [&](std::size_t row) { return std::abs(run.rows[row].alpha - run.rows[row - 1].alpha); };
  const double most = k_dwell_tolerance * travel_to(i);
  return travel_to(i + 1) < most && (i == 1 || travel_to(i - 1) < most);
}

/// θ at the time `lag` earlier, linear between samples. Before the first sample the joint rests.
std::vector<double> delayed(const BenchRun& run, const std::vector<double>& theta, double lag) {
  std::vector<double> late(theta.size());
  std::size_t j = 0;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const double time = run.rows[i].time - lag;
    while (j + 1 < theta.size() && run.rows[j + 1].time <= time) ++j;
    const double from = run.rows[j].time;
    const double step = j + 1 < theta.size() ? run.rows[j + 1].time - from : 0.0;
    const double share = step > 0 ? std::clamp((time - from) / step, 0.0, 1.0) : 0.0;
    if (share == 0)
      late[i] = theta[j];
    else if (has_unknown_arrival(run, j + 1))
      late[i] = theta[j + 1];
    else
      late[i] = theta[j] + share * (theta[j + 1] - theta[j]);
  }
  return late;
}

/// θ after the filter τ y' = θ − y, exact for linear θ between samples. Before the first sample the joint rests. The
/// filter restarts after rows without θ, and where the time of arrival is unknown.
std::vector<double> filtered(const BenchRun& run, const std::vector<double>& theta, double lag) {
  std::vector<double> smooth = theta;
  for (std::size_t i = 1; i < theta.size(); ++i) {
    const double time = run.rows[i].time - run.rows[i - 1].time;
    if (!(time > 0)) {
      smooth[i] = smooth[i - 1];
    } else if (std::isfinite(smooth[i - 1]) && !has_unknown_arrival(run, i)) {
      const double behind = lag * (theta[i] - theta[i - 1]) / time;  // lag behind a ramp in steady state
      smooth[i] = theta[i] - behind + (smooth[i - 1] - theta[i - 1] + behind) * elementary::exp(-time / lag);
    }
  }
  return smooth;
}

/// sin · sin nφ + cos · (cos nφ − 1)
double wave(double angle, double order, double sin_part, double cos_part) {
  if (sin_part == 0 && cos_part == 0) return 0;
  return sin_part * elementary::sin(order * angle) + cos_part * (elementary::cos(order * angle) - 1.0);
}

/// Transforms the coefficients of sin n(x + a) and cos n(x + a) to those of sin nx and cos nx. `angle`: n a, rad.
void turn_wave(double angle, double& sin_part, double& cos_part) {
  if (angle == 0) return;
  const double c = elementary::cos(angle), s = elementary::sin(angle);
  const double turned_sin = sin_part * c - cos_part * s;
  cos_part = sin_part * s + cos_part * c;
  sin_part = turned_sin;
}

}  // namespace

MotorSensorError turned(MotorSensorError error, double angle) {
  turn_wave(angle, error.eccentricity_sin, error.eccentricity_cos);
  turn_wave(error.wave_order * angle, error.wave_sin, error.wave_cos);
  return error;
}

JointSensorError turned(JointSensorError error, double angle) {
  turn_wave(angle, error.eccentricity_sin, error.eccentricity_cos);
  turn_wave(error.wave_order * angle, error.wave_sin, error.wave_cos);
  return error;
}

double shaft_angle(double alpha, const MotorSensorError& error) {
  return alpha + error.offset + wave(alpha, 1, error.eccentricity_sin, error.eccentricity_cos) +
         wave(alpha, error.wave_order, error.wave_sin, error.wave_cos);
}

double Play::to(double input, double width) {
  output_ = std::clamp(output_, input - 0.5 * width, input + 0.5 * width);
  return output_;
}

std::vector<double> sensed(const BenchRun& run, std::vector<double> theta, const JointSensorError& error) {
  if (error.lag != 0) theta = error.first_order > 0 ? filtered(run, theta, error.lag) : delayed(run, theta, error.lag);
  for (double& angle : theta) {
    const double true_angle = angle;
    angle = error.zero + (1.0 + error.gain) * true_angle +
            wave(true_angle, 1, error.eccentricity_sin, error.eccentricity_cos) +
            wave(true_angle, error.wave_order, error.wave_sin, error.wave_cos);
  }
  return theta;
}

}  // namespace fusee::joint
