/// \file
/// Measured runs of a joint: what a bench logged, read with suspicion and cut into strokes.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/joint/bench_log.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// A CSV text of RFC 4180: UTF-8, Latin-1 or UTF-16; lines end with LF, CR LF or CR; separators are comma, semicolon,
/// tab or blanks. The header is the first line that names the angles. The unit of a column is, in this order: what an
/// option says, what the column's name states ("theta_rad", "load [kg]"), or what its values show (with a note). An
/// InputError where none of them decides.
struct MeasurementOptions {
  std::map<std::string, std::string> columns;    ///< role → column name: {"load", "tau_out_Nm"}
  bool needs_theta = true;                       ///< false: what drove the joint is enough, as in read_driving()
  std::map<std::string, std::string> units;      ///< role → unit: {"time", "ms"}
  std::map<std::string, double> ticks_per_turn;  ///< alpha, theta → counts a turn; negative where they fall
  std::map<std::string, double> zero_ticks;      ///< alpha, theta → counts at home
  double alpha_span = 0;  ///< how far the declared joint moves, rad; 0: not known. See expecting()
  double theta_span = 0;
};

/// The options with the spans of a declared joint: they tell degrees from radians where no name states the unit.
MeasurementOptions expecting(const Mechanism& declared, MeasurementOptions options);

/// The name of a unit that a role can have, for options ("ms" for "msec"); "" for none.
std::string unit_for(const std::string& role, const std::string& spelling);
/// "s, ms, us, …": all of a role's units.
std::string units_for(const std::string& role);

/// One logged row. NaN where a column is absent.
struct Sample {
  double time = 0;         ///< s
  double alpha = 0;        ///< rad, unwrapped
  double theta = 0;        ///< rad, unwrapped
  double load = 0;         ///< in `load_unit`: N for load_N (a tip force, positive against +θ)
  double temperature = 0;  ///< °C
  double tension1 = 0;     ///< N
  double tension2 = 0;
  bool after_break = false;  ///< the log began again here: what the joint did before it is not known
};

/// Samples in one direction of α, from one reversal (or the run's beginning) to the next.
struct Stroke {
  std::size_t first = 0;  ///< index into the run's samples
  std::size_t last = 0;   ///< included
  int direction = 0;  ///< +1: α grows, −1: α falls, 0: α stands throughout the run and the load moves the joint
  int cycle = 0;
  bool partial = false;  ///< the first stroke of a run that did not begin at a reversal: its play state is unknown
};

/// Rows of a stroke that stand or fall together: all of it, one level of load on it, a motor angle that was held.
struct Stretch {
  std::size_t first = 0;   ///< index into the run's samples
  std::size_t last = 0;    ///< included
  std::size_t stroke = 0;  ///< index into the run's strokes: from which side α came
  bool held = false;       ///< α stands
  int pull = 0;            ///< held, what came last: 0: α moved here, +1: the load grew to what it is, −1: it fell
};

struct Run {
  std::string name;             ///< file name without its folder
  std::vector<Sample> samples;  ///< by time
  std::vector<Stroke> strokes;
  std::vector<Stretch> stretches;  ///< of the strokes, in their order; see stretches_of()
  double speed = 0;                ///< median |dα/dt|, rad/s; 0 without time, and from point to point
  double mean_load = 0;            ///< mean of the load column; 0 without
  bool has_time = false, has_load = false, has_temperature = false;
  Mounting mounting = {};  ///< of its encoders
};

struct Measurement {
  std::vector<Run> runs;
  double alpha_quantum = 0;  ///< step of the sensor, rad; 0 when it is finer than can be told
  double theta_quantum = 0;
  std::string load_unit;                  ///< of the loads: "N", "Nm", "Nmm"; "" without any
  std::vector<std::string> notes;         ///< what was dropped, repaired or suspected, with file and line
  std::vector<std::string> not_testable;  ///< reasons why nothing can be concluded; empty when it can
};

/// Reads and checks all files. InputError (file, line, what to change) for what cannot be read and for a run given
/// twice; `not_testable` for what can be read but not used. Files of any length: of all together a million rows are
/// kept, evenly, and a note says so.
Measurement read_measurement(const std::vector<std::filesystem::path>& files, const MeasurementOptions& options = {});

/// The same for a joint: compare_with_declared() is done.
Measurement read_measurement(const std::vector<std::filesystem::path>& files, const Mechanism& declared,
                             const MeasurementOptions& options = {});

/// What drives a joint, logged or planned, for those who ask what the joint will do: one run, rows in order of time, α
/// unwrapped, load and temperature without gaps. θ is NaN where there is none; strokes are not looked for. A torque is
/// taken as a tip force, as in compare_with_declared(). InputError, also where no row holds α.
Measurement read_driving(const std::filesystem::path& file, const Mechanism& declared, MeasurementOptions options = {});

/// One run from text; `name` stands in the messages. InputError. Notes and reasons go to `into`.
Run parse_run(std::string_view text, const std::string& name, const MeasurementOptions& options, Measurement& into);

/// The roles that a column can have, and the column that has each unless the options say otherwise: {"alpha",
/// "alpha_deg"} …
const std::vector<std::pair<std::string, std::string>>& column_roles();
/// Columns that hold one value a run: how the encoders were mounted in it.
inline constexpr std::string_view k_motor_sensor_turned = "motor_sensor_turned";  ///< role; column …_deg
inline constexpr std::string_view k_joint_sensor_turned = "joint_sensor_turned";

/// The run's stretches; of a run that was not read but made, its whole strokes.
std::vector<Stretch> stretches_of(const Run& run);

/// Whether the motor stood in most rows: steps between held angles, loads put on and taken off at one angle.
bool is_from_point_to_point(const Run& run);

/// What drove the joint in these runs.
BenchLog bench_log(const Measurement& measurement);

/// Takes back whole turns at which an encoder began (with a note). Data that cannot be of the declared joint are said
/// and not fitted: α and θ exchanged, opposite sign, radians given as degrees, a zero that was not set, a motion lost
/// in noise. Adds the reasons to `not_testable`. A torque is taken as a tip force where the joint has tendons (with a
/// note).
void compare_with_declared(const Mechanism& declared, Measurement& measurement);
/// Its last step: the tendons' elastic model takes N across OC.
void take_torques_as_forces(const Mechanism& declared, Measurement& measurement);

/// Noise of repeats at one level of load and speed.
struct NoiseLevel {
  double load = 0;                ///< as Sample
  double speed = 0;               ///< rad/s; 0 without time
  double rms = 0;                 ///< scatter between repeats, rad
  double degrees_of_freedom = 0;  ///< as NoiseFloor
  double largest_at = 0;          ///< α about which repeats differ most, rad
};

/// Scatter of θ between repeats at the same α, direction, load and speed, before any fit. Repeats within a run, or
/// where there are none, of runs that repeat one another: as far as they agree. What differs between two runs smoothly
/// is no noise, something was changed between them. Single wild rows do not count.
struct NoiseFloor {
  double rms = 0;                 ///< rad; never below the error of the sensors' own steps, quantum/√12
  double degrees_of_freedom = 0;  ///< of rms², colour and shared strokes allowed for
  bool from_repeats = false;      ///< false: no repeats; taken from differences of neighbours, a lower bound
  double colour = 0;        ///< correlation of the noise of neighbouring rows of the log, 0 … 0.99; 0 without repeats
  double between_runs = 0;  ///< rms by which runs that should repeat differ smoothly, rad; 0 where they agree
  /// scatter of most neighbouring rows about one another, from third differences, and of the sensors' own steps, rad:
  /// what of the noise a single stroke shows. 0: too few rows.
  double within_stroke = 0;
  std::vector<NoiseLevel> levels;  ///< of repeats within runs, by load and speed; none without enough of them

  /// As many independent rows' worth in the mean of `rows` rows, of which each is the `every`-th of the log.
  double effective_rows(double rows, double every = 1) const;
};
NoiseFloor noise_floor(const Measurement& measurement);

/// ISO 230-2 of deviations (rad): up and down strokes at fixed positions of α.
struct Iso230 {
  double A = 0;  ///< accuracy
  double R = 0;  ///< bidirectional repeatability
  double B = 0;  ///< reversal
  double E = 0;  ///< systematic deviation
  double M = 0;  ///< range of the mean bidirectional deviation
};
/// `deviations[i][d][k]`: position i, direction d (0 up, 1 down), repeat k.
Iso230 iso230(const std::vector<std::array<std::vector<double>, 2>>& deviations);
/// From residuals (rad), one vector a run, parallel to the samples.
Iso230 iso230(const Measurement& measurement, const std::vector<std::vector<double>>& residuals);

}  // namespace fusee
