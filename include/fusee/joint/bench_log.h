/// \file
/// What drives a joint on its bench: logged motor angles, loads, temperatures, run by run.
#pragma once

#include <vector>

namespace fusee {

struct BenchRow {
  double time = 0;         ///< s; 0 where it was not logged
  double alpha = 0;        ///< as the motor's sensor showed it, rad
  double load = 0;         ///< tip force, positive against +θ, N; of a joint declared by a ratio in the log's own unit
  double temperature = 0;  ///< °C
};

/// How far an encoder was turned on what it measures since home was set, and its zero set again, rad: what it errs by
/// once a turn changes its phase.
struct Mounting {
  double motor_sensor_turned = 0;
  double joint_sensor_turned = 0;

  bool operator==(const Mounting&) const = default;
};

struct BenchRun {
  std::vector<BenchRow> rows;  ///< by time
  bool has_load = false;       ///< else the declared load acts
  bool has_temperature = false;
  Mounting mounting = {};
};

/// Runs in the order in which they were made.
using BenchLog = std::vector<BenchRun>;

/// What is added to each run's time so that runs whose clocks begin anew follow one another. s
std::vector<double> bench_clock(const BenchLog& log);

}  // namespace fusee
