/// \file
/// What a person can do at the bench: runs to drive, numbers to read by hand. The one vocabulary of `fusee plan` and of
/// what `fusee calibrate` says to measure next.
#pragma once

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
  doubled_pretension,
  on_its_side,  ///< the joint's axis upright: its weight does not turn it
};
/// "turn the joint's encoder on its axis by a quarter turn"; "" for none.
std::string_view words(BenchChange change);
/// The joint and what it is not, with that changed.
struct ChangedJoint {
  Mechanism declared;
  Imperfections at;
};
ChangedJoint changed(const Mechanism& declared, const Imperfections& at, BenchChange change);
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
/// "3 slow cycles at 5 N": `slow` is the pace that is called so.
std::string words(const PlannedRun& run, double slow, const std::string& load_unit);
/// Rows evenly over every stroke, `rows_a_stroke` each, and over every dwell.
BenchRun driven(const PlannedRun& run, int rows_a_stroke);

/// Something to measure, whichever kind: what the person reads, and how well it tells apart each of some pairs of
/// explanations: 1 is just told.
struct RankedMeasurement {
  std::string words;
  double minutes = 0;
  std::vector<double> margins;

  std::size_t told() const;
  double most() const;
};
/// The most telling first: most pairs, then the widest margin. Of equals the earlier one.
void rank(std::vector<RankedMeasurement>& measurements);

/// Root mean square of what two simulations of the same rows differ by, rad; rows without an angle do not count.
double rms_apart(const std::vector<std::vector<double>>& one, const std::vector<std::vector<double>>& other);

/// Numbers of the joint that can be read by hand, of all effects that it can have.
std::vector<const EffectParameter*> hand_readable(const Mechanism& declared);

}  // namespace fusee
