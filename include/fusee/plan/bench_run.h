/// \file
/// Measurements that a person can make at the bench: runs to drive and dimensions to read by hand. `fusee plan` and the
/// next measurements of `fusee calibrate` share these types.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/joint/bench_log.h"
#include "fusee/mechanism/effect.h"

namespace fusee {

/// Over less than this motor angle, rad, an error of period one turn is indistinguishable from a linear one.
inline constexpr double k_full_turn = radians(150.0);

/// A change on the bench before a run, undone after it.
enum class BenchChange {
  none,
  motor_sensor_turned,  ///< turned by a quarter turn against the pulley, home set again
  joint_sensor_turned,  ///< turned by a quarter turn against the joint, home set again
};
/// The instruction, such as "turn the joint's encoder on its axis by a quarter turn"; "" for none.
std::string_view words(BenchChange change);
/// The angles of both encoders on their shafts after that change.
Mounting mounting_of(BenchChange change);

/// Strokes between two motor angles, there and back, at constant speed and load.
struct PlannedRun {
  double from = 0;  ///< motor angle at which the log begins, rad
  double to = 0;
  int cycles = 3;    ///< strokes there and back; the first stroke of a log only settles the play
  double speed = 0;  ///< of the motor, rad/s
  double load = 0;   ///< tip force, N; for a joint declared by a ratio in the log's own unit
  double dwell = 0;  ///< pause at either end of every stroke, s
  BenchChange change = BenchChange::none;
};

/// Duration of all strokes and dwells, min.
double minutes_of(const PlannedRun& run);
/// Time to hang the load and to turn the encoder there and back, min.
double setup_minutes_of(const PlannedRun& run);
/// A phrase such as "3 slow cycles at 5 N". `slow`, rad/s, is the speed that is called slow.
std::string words(const PlannedRun& run, double slow, const std::string& load_unit);
/// Simulated rows: `rows_a_stroke` evenly over every stroke, then every dwell.
BenchRun driven(const PlannedRun& run, int rows_a_stroke);

/// A measurement that distinguishes causes that the runs so far do not.
struct NextMeasurement {
  std::optional<PlannedRun> run;  ///< a run to drive
  /// Parameters of one effect to read by hand, if there is no run. Without both, see `words`.
  std::vector<const EffectParameter*> readings;
  std::string words;                   ///< the instruction
  std::string gain;                    ///< "backlash from creep (4 × the uncertainty)"; "" if unknown
  std::vector<std::string> separates;  ///< names of effects; may include "unmodelled"
  double minutes = 0;                  ///< including the changes on the bench

  /// "run", "turn_sensor", the tool of a reading as "caliper", or "inspect".
  std::string_view kind() const;
  std::string text() const;  ///< `words` and `gain` in one sentence
};
/// A run with its instruction and minutes. `slow` and `load_unit` as in words().
NextMeasurement next_run(const PlannedRun& run, double slow, const std::string& load_unit);
/// Hand measurements of the parameters of one effect, at least one.
NextMeasurement next_reading(const std::vector<const EffectParameter*>& readings);
/// Any other measurement.
NextMeasurement next_inspection(const std::string& words);

/// Root mean square difference of two simulations of the same rows, rad. Rows without an angle do not count.
double rms_apart(const std::vector<std::vector<double>>& one, const std::vector<std::vector<double>>& other);

/// Parameters of this joint's effects that can be read by hand and that [prior] does not have yet.
std::vector<const EffectParameter*> unread_numbers(const DeclaredMechanism& declared);

}  // namespace fusee
