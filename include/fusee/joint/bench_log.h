/// \file
/// Inputs to a joint on its bench: logged motor angles, loads and temperatures of each run.
#pragma once

#include <vector>

namespace fusee {

struct BenchRow {
  double time = 0;   ///< s; 0 if not logged
  double alpha = 0;  ///< reading of the motor's sensor, rad
  double load = 0;   ///< tip force, positive against +θ, N; for a joint declared by a ratio in the log's own unit
  double temperature = 0;  ///< °C
};

/// Rotation of the encoders on their shafts since home was set, with the zero set again, rad. It shifts the phase of an
/// encoder's periodic errors.
struct Mounting {
  double motor_sensor_turned = 0;
  double joint_sensor_turned = 0;

  bool operator==(const Mounting&) const = default;
};

struct BenchRun {
  std::vector<BenchRow> rows;  ///< sorted by time
  bool has_load = false;       ///< false: the declared load acts
  bool has_temperature = false;
  Mounting mounting = {};
};

/// Runs in chronological order.
using BenchLog = std::vector<BenchRun>;

/// Offsets for the times of each run, so that runs with restarted clocks follow one another. s
std::vector<double> bench_clock(const BenchLog& log);

}  // namespace fusee
