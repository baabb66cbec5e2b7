/// \file
/// What a person can do at the bench: runs to drive, numbers to read by hand. The one vocabulary of `fusee plan` and of
/// what `fusee calibrate` says to measure next.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/joint/bench_log.h"
#include "fusee/mechanism/effect.h"

namespace fusee {

/// Less than this of a turn of the motor, and what comes back once a turn looks like a slope. rad
inline constexpr double k_full_turn = radians(150.0);

/// What is changed on the bench before a run, and put back after it.
enum class BenchChange {
  none,
  motor_sensor_turned,  ///< a quarter turn against the pulley, home set again
  joint_sensor_turned,  ///< a quarter turn against the joint, home set again
};
/// "turn the joint's encoder on its axis by a quarter turn"; "" for none.
std::string_view words(BenchChange change);
/// How the encoders are mounted then.
Mounting mounting_of(BenchChange change);

/// Strokes between two motor angles, there and back, at one pace and under one load.
struct PlannedRun {
  double from = 0;  ///< motor, rad: where the log begins
  double to = 0;
  int cycles = 3;    ///< there and back; of a log's strokes the first finds out where the play stands
  double speed = 0;  ///< of the motor, rad/s
  double load = 0;   ///< tip force, N; of a joint declared by a ratio in the log's own unit
  double dwell = 0;  ///< held at either end of every stroke, s
  BenchChange change = BenchChange::none;
};

/// Time under way and held, min.
double minutes_of(const PlannedRun& run);
/// Time to hang its load on and to turn its sensor there and back, min.
double setup_minutes_of(const PlannedRun& run);
/// "3 slow cycles at 5 N": `slow` is the pace that is called so.
std::string words(const PlannedRun& run, double slow, const std::string& load_unit);
/// Rows evenly over every stroke, `rows_a_stroke` each, and over every dwell.
BenchRun driven(const PlannedRun& run, int rows_a_stroke);

/// A measurement that would distinguish causes that the runs so far do not.
struct NextMeasurement {
  std::optional<PlannedRun> run;                 ///< to drive …
  std::vector<const EffectParameter*> readings;  ///< … or numbers of one effect to read by hand; neither: see `words`
  std::string words;                             ///< what to do
  std::string gain;                    ///< "backlash from creep (4 × the uncertainty)"; "" where that is not known
  std::vector<std::string> separates;  ///< names of effects, "unmodelled" among them
  double minutes = 0;                  ///< with what has to be changed on the bench for it

  /// "run", "turn_sensor", the tool of a reading as "caliper", or "inspect".
  std::string_view kind() const;
  std::string text() const;  ///< `words` and `gain` as a sentence
};
/// A run with its words and minutes. `slow`, `load_unit`: as in words().
NextMeasurement next_run(const PlannedRun& run, double slow, const std::string& load_unit);
/// Readings of one effect, at least one.
NextMeasurement next_reading(const std::vector<const EffectParameter*>& readings);
/// Any other measurement.
NextMeasurement next_inspection(const std::string& words);

/// Root mean square of what two simulations of the same rows differ by, rad; rows without an angle do not count.
double rms_apart(const std::vector<std::vector<double>>& one, const std::vector<std::vector<double>>& other);

/// Numbers of the joint that can be read by hand and that [prior] does not have yet, of all effects that it can have.
std::vector<const EffectParameter*> unread_numbers(const DeclaredMechanism& declared);

}  // namespace fusee
