/// \file
/// Measured runs of a joint: logs, read, checked, repaired and cut into strokes.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/mechanism.h"

namespace fusee::measurement {

/// CSV text as in RFC 4180: UTF-8, Latin-1 or UTF-16; lines end with LF, CR LF or CR; separated by comma, semicolon,
/// tab, bar or blanks. The header is the first line that names the angles. The unit of a column is taken from the
/// options, else from its name ("theta_rad", "load [kg]"), else from its values (with a note). Reading throws
/// InputError if none of them determines it.
///
/// Recordings of ROS 2: MCAP files, SQLite files of ros2 bag, or a bag's folder, known by their content. Their numbers
/// are columns with the names that PlotJuggler gives them, "/joint_states/motor/position", in rad, N and N·m; "time" is
/// "header_stamp" or "log_time". Motor and joint may be chosen by their names. Numbers with times of their own, in a
/// bag or in a table of PlotJuggler, are interpolated in time.
struct MeasurementOptions {
  /// role → column name: {"load", "tau_out_Nm"}. For a ROS name, its end suffices: "motor".
  std::map<std::string, std::string> columns;
  bool needs_theta = true;                   ///< false: theta may be missing, as in read_driving()
  std::map<std::string, std::string> units;  ///< role → unit: {"time", "ms"}
  /// alpha, theta → counts per turn; negative if counts fall while the angle grows
  std::map<std::string, double> ticks_per_turn;
  std::map<std::string, double> zero_ticks;     ///< alpha, theta → counts at home
  std::map<std::string, double> home_readings;  ///< alpha, theta → reading at home, in the column's own unit
  double alpha_span = 0;                        ///< range of α of the declared joint, rad; 0: unknown. See expecting()
  double theta_span = 0;                        ///< range of θ of the declared joint, rad; 0: unknown
  double tip_force = 0;                         ///< declared tip force, N: assumed for a run without a load
  double load_scale = 0;  ///< size of the declared load as a tip force, N; 0: unknown. See expecting()
};

/// Adds the ranges of a declared joint, which distinguish degrees from radians where no name states the unit.
MeasurementOptions expecting(const Mechanism& declared, MeasurementOptions options);

/// Canonical name of a role's unit, for options ("ms" for "msec"); "" if there is none.
std::string unit_for(const std::string& role, const std::string& spelling);
/// All units of a role: "s, ms, us, …".
std::string units_for(const std::string& role);

/// One logged row. NaN where a column is absent.
struct Sample {
  double time = 0;   ///< s
  double alpha = 0;  ///< rad, unwrapped
  double theta = 0;  ///< rad, unwrapped
  double load = 0;   ///< in `load_unit`: N for load_N (a tip force, positive against +θ)
  double temperature_C = 0;
  double tension1 = 0;       ///< of tendon 1, N
  double tension2 = 0;       ///< of tendon 2, N
  bool after_break = false;  ///< the log restarts here: the play state before this row is unknown
};

/// Samples in one direction of α, from one reversal (or the run's beginning) to the next.
struct Stroke {
  std::size_t first = 0;  ///< index into the run's samples
  std::size_t last = 0;   ///< included
  int direction = 0;  ///< +1: α grows, −1: α falls, 0: α is constant throughout the run and the load moves the joint
  int cycle = 0;      ///< number of the cycle, counted from the first complete stroke
  bool partial = false;  ///< its play state is unknown: after a gap, or at the beginning of a run
};

/// Rows of a stroke that count as one observation: the whole stroke, one load level of it, or one dwell.
struct Segment {
  std::size_t first = 0;   ///< index into the run's samples
  std::size_t last = 0;    ///< included
  std::size_t stroke = 0;  ///< index into the run's strokes: the direction from which α came
  bool is_dwell = false;   ///< α is constant
  int pull = 0;            ///< cause of the state in a dwell: 0: α moved here, +1: the load rose, −1: the load fell
};

/// One run: rows, strokes and segments.
struct Run {
  std::string name;             ///< file name without folder
  std::vector<Sample> samples;  ///< by time
  std::vector<Stroke> strokes;
  std::vector<Segment> segments;  ///< in the order of the strokes; see segments_of()
  double speed = 0;               ///< median |dα/dt|, rad/s; 0 without time and for point-to-point logs
  double mean_load = 0;           ///< mean of the load column; 0 without load
  bool has_time = false, has_load = false, has_temperature = false;
  joint::Mounting mounting = {};  ///< of the encoders
};

/// All runs of one joint, with notes on their repair.
struct Measurement {
  std::vector<Run> runs;
  double alpha_quantum = 0;               ///< step of the motor's sensor, rad; 0 if it is too fine to be detected
  double theta_quantum = 0;               ///< step of the joint's sensor, rad; 0 if it is too fine to be detected
  std::string load_unit;                  ///< of the loads: "N", "Nm", "Nmm"; "" without loads
  std::vector<std::string> notes;         ///< rows dropped or repaired and likely faults, with file and line
  std::vector<std::string> sources;       ///< topics and clock of a bag's rows, columns not used; not in any result
  std::vector<std::string> not_testable;  ///< reasons why the data cannot be evaluated; empty if they can
};

/// Reads and checks all files. Throws InputError (file, line, what to change) for unreadable text and for a run that is
/// given twice. Readable data that cannot be evaluated are reported in `not_testable`. Of n files each may have 1/n of
/// a million rows. Of a longer file every second, fourth … row is kept, and a note says so.
Measurement read_measurement(const std::vector<std::filesystem::path>& files, const MeasurementOptions& options = {},
                             FileAccess& access = disk());

/// Reads and checks the files, then runs compare_with_declared().
Measurement read_measurement(const std::vector<std::filesystem::path>& files, const Mechanism& declared,
                             const MeasurementOptions& options = {}, FileAccess& access = disk());

/// Reads the input of a simulation, logged or planned: one run in order of time, α unwrapped, load and temperature
/// without gaps. Missing θ is NaN, and strokes are not determined. A torque is converted as in compare_with_declared().
/// Throws InputError, also if no row has α.
Measurement read_driving(const std::filesystem::path& file, const Mechanism& declared, MeasurementOptions options = {},
                         FileAccess& access = disk());

/// Parses one run; `name` appears in messages. Notes and reasons go to `into`. Throws InputError.
Run parse_run(std::string_view text, const std::string& name, const MeasurementOptions& options, Measurement& into);

/// All roles of columns, each with its default column name: {"alpha", "alpha_deg"} …
const std::vector<std::pair<std::string, std::string>>& column_roles();
/// Columns with one value per run: the mounting angles of the encoders.
inline constexpr std::string_view k_motor_sensor_turned = "motor_sensor_turned";  ///< role; column …_deg
inline constexpr std::string_view k_joint_sensor_turned = "joint_sensor_turned";

/// The run's segments; for a run that was not read from a file, its whole strokes.
std::vector<Segment> segments_of(const Run& run);

/// True if the motor stands in most rows: a log of dwells, or of loads changed at one motor angle.
bool is_from_point_to_point(const Run& run);

/// Motor angles, loads, temperatures and times of the runs, as input of a simulation.
joint::BenchLog bench_log(const Measurement& measurement);

/// Removes whole turns by which an encoder starts elsewhere (with a note). Converts torques to tip forces if the joint
/// has tendons (with a note). Adds a reason to `not_testable` if the data cannot come from the declared joint: α and θ
/// exchanged, a sign reversed, radians read as degrees, a zero that was not set, or a motion smaller than the noise.
void compare_with_declared(const Mechanism& declared, Measurement& measurement);
/// Converts torques to tip forces: the elastic model takes N across OC. Part of compare_with_declared().
void take_torques_as_forces(const Mechanism& declared, Measurement& measurement);

/// Noise of repeats at one load level and speed.
struct NoiseLevel {
  double load = 0;                ///< as in Sample
  double speed = 0;               ///< rad/s; 0 without time
  double rms = 0;                 ///< scatter between repeats, rad
  double degrees_of_freedom = 0;  ///< as in NoiseFloor
  double largest_at = 0;          ///< α at which repeats differ most, rad; 0 if it is unknown
};

/// Scatter of θ between repeats at the same α, direction, load and speed, before any fit. Repeats are taken within
/// runs; if there are none, between runs that agree. A smooth difference between two runs is a change of the joint, not
/// noise. Single outliers do not count.
struct NoiseFloor {
  double rms = 0;                 ///< rad; at least the quantisation error of the sensors, quantum/√12
  double degrees_of_freedom = 0;  ///< of rms², reduced for correlated noise and shared strokes
  bool from_repeats = false;      ///< false: estimated from differences of neighbouring rows, a lower bound
  double colour = 0;              ///< correlation of the noise of neighbouring rows, 0 … 0.99; 0 without repeats
  double between_runs = 0;        ///< rms of smooth differences between runs that should repeat, rad; 0 if they agree
  /// Noise within a single stroke, rad: scatter of neighbouring rows (third differences) and quantisation. 0 if there
  /// are too few rows.
  double within_stroke = 0;
  std::vector<NoiseLevel> levels;  ///< noise of repeats within runs by load and speed; empty if there are too few

  /// Number of independent rows that have the information of `rows` rows, each the `every`-th of the log.
  double effective_rows(double rows, double every = 1) const;
};
/// Estimates the noise from repeats, before any fit. A lower bound without repeats.
NoiseFloor noise_floor(const Measurement& measurement);

/// Figures of ISO 230-2, rad, from up and down strokes at fixed positions of α.
struct Iso230 {
  double A = 0;  ///< accuracy
  double R = 0;  ///< bidirectional repeatability
  double B = 0;  ///< reversal
  double E = 0;  ///< systematic deviation
  double M = 0;  ///< range of the mean bidirectional deviation
};
/// `deviations[i][d][k]`: position i, direction d (0 up, 1 down), repeat k.
Iso230 iso230(const std::vector<std::array<std::vector<double>, 2>>& deviations);
/// `residuals`, rad: one vector per run, parallel to its samples.
Iso230 iso230(const Measurement& measurement, const std::vector<std::vector<double>>& residuals);

}  // namespace fusee::measurement
