#include "fusee/measurement.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "measurement/clock.h"
#include "measurement/columns.h"
#include "measurement/repair.h"
#include "measurement/row_reader.h"
#include "measurement/run_checks.h"
#include "measurement/segments.h"
#include "measurement/strokes.h"

// From bytes to runs in three steps:
//   1. Rows (log_file): the file is read in blocks, and a long run is thinned meanwhile, so that memory is bounded.
//      CSV (row_reader): bytes to records (csv_text), header to columns and units (columns, angle_words, units,
//      settled_units), cells to numbers (cells).
//      Bags (mcap, sqlite_bag): bytes to messages, messages to numbers (ros_messages), numbers by topic to rows
//      (bag_log, tracks).
//   2. Repair: order in time (clock), wrap-around and outliers (repair); each with a note.
//   3. Strokes (strokes) and segments (segments), and checks whether the runs can be evaluated at all (run_checks).

namespace fusee::measurement {
namespace {

/// True for a run file of `fusee plan` that is not filled in yet.
bool is_unfilled(const LoggedRows& rows) { return rows.rows > 0 && rows.without_theta == rows.rows; }

std::string all_rows_text(std::size_t rows) { return rows == 1 ? "its only row" : "all " + rows_text(rows); }

void note_rows_read(const LoggedRows& rows, const std::string& name, const NoteSink& add_note, Measurement& into) {
  for (const std::string& note : rows.notes) add_note(note);
  for (const std::string& source : rows.sources) into.sources.push_back(name + ": " + source);
  if (rows.stride > 1) {
    add_note("of " + std::to_string(rows.rows) + " rows one in " + std::to_string(rows.stride) + " is used: at most " +
             std::to_string(k_most_samples) + " rows are kept, divided equally among the files");
  }
  if (rows.without_angle == 0) return;
  if (is_unfilled(rows)) {
    into.not_testable.push_back(name + ": no measured rows: theta is empty in " + all_rows_text(rows.rows) +
                                "; fill in the angles of the joint's sensor in this run of 'fusee plan'");
    return;
  }
  add_note(rows_text(rows.without_angle) + " without alpha or theta, the first in line " +
           std::to_string(rows.first_without_angle) + ": omitted");
  if (2 * rows.without_angle > rows.rows)
    into.not_testable.push_back(name + ": more than half of the rows have no angle");
}

void repair(Run& run, const NoteSink& add_note) {
  if (run.has_time) order_time(run, add_note);
  // θ first: where θ moves far, a jump of α by a turn is a motion.
  unwrap(run.samples, &Sample::theta, "theta", add_note);
  unwrap(run.samples, &Sample::alpha, "alpha", add_note);
  drop_outliers(run, add_note);
  run.has_load = run.has_load && fill_gaps(run.samples, &Sample::load, "load", add_note);
  run.has_temperature = run.has_temperature && fill_gaps(run.samples, &Sample::temperature_C, "temperature", add_note);
}

void compute_speed_and_load(Run& run) {
  if (run.has_time) {
    std::vector<double> speeds;
    for (std::size_t i = 1; i < run.samples.size(); ++i) {
      const double step = run.samples[i].time - run.samples[i - 1].time;
      if (step > 0) speeds.push_back(std::abs(run.samples[i].alpha - run.samples[i - 1].alpha) / step);
    }
    run.speed = is_from_point_to_point(run) ? 0.0 : median_of(std::move(speeds));
  }
  if (!run.has_load) return;
  for (const Sample& sample : run.samples) run.mean_load += sample.load / static_cast<double>(run.samples.size());
}

/// Adds a note for a sweep whose rows are more than 2 s apart: its time may be in another unit.
void note_implausible_steps(const Run& run, std::size_t stride, const NoteSink& add_note) {
  if (!run.has_time || run.samples.size() < 2 || is_from_point_to_point(run)) return;
  const double span = run.samples.back().time - run.samples.front().time;
  const double step = span / static_cast<double>((run.samples.size() - 1) * stride);
  if (step > k_longest_step)
    add_note("the rows are " + rounded(step, 3) +
             " s apart: if the times are in ms, end their column's name in _ms, or give --unit time=ms");
}

/// Determines strokes, segments and the sensors' steps.
void cut_run(Run& run, Measurement& into, double alpha_quantum) {
  std::vector<RowRange> dwells = dwells_in(run.samples, alpha_quantum);
  const double theta_quantum = quantum_of(run.samples, &Sample::theta);
  const double alpha_step = sensor_quantum(dwells, run.samples, &Sample::alpha, alpha_quantum);
  into.alpha_quantum = std::max(into.alpha_quantum, alpha_step);
  into.theta_quantum = std::max(into.theta_quantum, sensor_quantum(dwells, run.samples, &Sample::theta, theta_quantum));
  run.strokes = split_strokes(run.samples, dwells, alpha_step, run.has_time);
  // At a constant α, load levels alone move the joint: one stroke without a direction.
  if (run.strokes.empty() && has_levels_of_load(run)) {
    dwells = {{0, run.samples.size() - 1}};
    run.strokes = {{0, run.samples.size() - 1, 0, 0, false}};
  }
  run.segments = cut_segments(run, dwells);
}

/// N·mm in a unit of torque; 0 for N.
double Nmm_in(const std::string& unit) { return unit == "Nm" ? 1000.0 : unit == "Nmm" ? 1.0 : 0.0; }

/// Converts the loads of a run to the unit of the first run. Throws InputError if one is a force and the other a
/// torque.
void take_load_unit(const std::string& unit, Run& run, Measurement& into) {
  if (into.load_unit.empty()) into.load_unit = unit;
  if (into.load_unit == unit) return;
  if (Nmm_in(unit) == 0 || Nmm_in(into.load_unit) == 0)
    throw InputError(run.name, "has loads in " + unit + ", and an earlier run in " + into.load_unit,
                     "log forces in all runs, or torques in all");
  const double factor = Nmm_in(unit) / Nmm_in(into.load_unit);
  for (Sample& sample : run.samples) sample.load *= factor;
  run.mean_load *= factor;
}

Run make_run(const std::string& name, LoggedRows rows, Measurement& into) {
  const NoteSink add_note = [&](const std::string& words) { into.notes.push_back(name + ": " + words); };
  note_rows_read(rows, name, add_note, into);
  Run run;
  run.name = name;
  run.samples = std::move(rows.samples);
  run.has_time = rows.has_time;
  run.has_load = rows.has_load;
  run.has_temperature = rows.has_temperature;
  run.mounting = rows.mounting;
  if (!run.samples.empty()) {
    const double alpha_quantum = quantum_of(run.samples, &Sample::alpha);  // before rows are averaged
    repair(run, add_note);
    cut_run(run, into, alpha_quantum);
    compute_speed_and_load(run);
    note_implausible_steps(run, rows.stride, add_note);
  }
  if (!is_unfilled(rows)) check_run(run, into, add_note);
  if (run.has_load) take_load_unit(rows.load_unit, run, into);
  return run;
}

/// File name without folder; of a bag, its folder's name.
std::string run_name(const std::filesystem::path& file) {
  return (file.has_filename() ? file : file.parent_path()).filename().string();
}

/// Names of the runs; files of the same name in two folders are named by their paths.
std::vector<std::string> run_names(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const auto& file : files) {
    const std::string name = run_name(file);
    const auto same =
        std::count_if(files.begin(), files.end(), [&](const auto& other) { return run_name(other) == name; });
    names.push_back(same > 1 ? file.string() : name);
  }
  return names;
}

/// Merges equal sources "RUN: WORDS" into one, with the name of the first run and the number of the others.
void merge_sources(std::vector<std::string>& sources) {
  constexpr std::string_view k_mark = ": ";
  std::vector<std::pair<std::string, std::vector<std::string>>> runs_by_words;
  for (const std::string& source : sources) {
    const std::size_t mark = source.find(k_mark);
    const std::string run = source.substr(0, mark), words = source.substr(mark + k_mark.size());
    const auto known = std::find_if(runs_by_words.begin(), runs_by_words.end(),
                                    [&words](const auto& each) { return each.first == words; });
    if (known == runs_by_words.end())
      runs_by_words.push_back({words, {run}});
    else
      known->second.push_back(run);
  }
  sources.clear();
  for (const auto& [words, runs] : runs_by_words) {
    const std::string more = runs.size() > 1 ? " and " + std::to_string(runs.size() - 1) + " more" : "";
    sources.push_back(runs.front() + more + std::string(k_mark) + words);
  }
}

bool same_rows(const std::vector<Sample>& a, const std::vector<Sample>& b) {
  const auto are_equal = [](const Sample& one, const Sample& other) {
    return one.alpha == other.alpha && one.theta == other.theta;
  };
  return a.size() > 1 && std::equal(a.begin(), a.end(), b.begin(), b.end(), are_equal);
}

/// Throws InputError for a run that is given twice: it would confirm itself.
void refuse_copies(const std::vector<std::filesystem::path>& files, const std::vector<Run>& runs) {
  std::vector<Diagnostic> problems;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!same_rows(runs[i].samples, runs[j].samples)) continue;
      const InputError problem(files[i].string(), "has the same rows as " + files[j].string(),
                               "a run counts once: remove one of the two");
      problems.push_back(problem.diagnostics().front());
      break;
    }
  }
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& column_roles() {
  static const std::vector<std::pair<std::string, std::string>> roles = {
      {"alpha", "alpha_deg"},
      {"theta", "theta_deg"},
      {"time", "time_s"},
      {"load", "load_N"},
      {"temperature", "temperature_C"},
      {"tension1", "tension1_N"},
      {"tension2", "tension2_N"},
      {"cycle", "cycle"},
      {std::string(k_motor_sensor_turned), "motor_sensor_turned_deg"},
      {std::string(k_joint_sensor_turned), "joint_sensor_turned_deg"}};
  return roles;
}

Run parse_run(std::string_view text, const std::string& name, const MeasurementOptions& options, Measurement& into) {
  check_roles(options);
  return make_run(name, read_rows(text, name, options), into);
}

Measurement read_measurement(const std::vector<std::filesystem::path>& files, const MeasurementOptions& options,
                             FileAccess& access) {
  check_roles(options);
  Measurement measurement;
  std::vector<Diagnostic> problems;
  const std::vector<std::string> names = run_names(files);
  const std::size_t most_rows_per_file =
      std::max<std::size_t>(2, k_most_samples / std::max<std::size_t>(1, files.size()));
  for (std::size_t i = 0; i < files.size(); ++i) {
    try {
      measurement.runs.push_back(
          make_run(names[i], read_rows(files[i], files[i].string(), options, access, most_rows_per_file), measurement));
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!problems.empty()) throw InputError(problems);
  merge_sources(measurement.sources);
  refuse_copies(files, measurement.runs);
  check_all_runs(measurement);
  return measurement;
}

Measurement read_measurement(const std::vector<std::filesystem::path>& files, const Mechanism& declared,
                             const MeasurementOptions& options, FileAccess& access) {
  Measurement measurement = read_measurement(files, expecting(declared, options), access);
  compare_with_declared(declared, measurement);
  return measurement;
}

Measurement read_driving(const std::filesystem::path& file, const Mechanism& declared, MeasurementOptions options,
                         FileAccess& access) {
  options = expecting(declared, std::move(options));
  options.needs_theta = false;
  check_roles(options);
  Measurement measurement;
  Run& run = measurement.runs.emplace_back();
  run.name = run_name(file);
  const NoteSink add_note = [&](const std::string& words) { measurement.notes.push_back(run.name + ": " + words); };
  LoggedRows rows = read_rows(file, file.string(), options, access);
  if (rows.samples.empty())
    throw InputError(file.string(), "no row has alpha",
                     "write one row per line: alpha_deg and, if known, time_s,load_N");
  note_rows_read(rows, run.name, add_note, measurement);
  run.samples = std::move(rows.samples);
  run.mounting = rows.mounting;
  run.has_time = rows.has_time;
  if (run.has_time) order_time(run, add_note);
  unwrap(run.samples, &Sample::alpha, "alpha", add_note);
  run.has_load = rows.has_load && fill_gaps(run.samples, &Sample::load, "load", add_note);
  run.has_temperature = rows.has_temperature && fill_gaps(run.samples, &Sample::temperature_C, "temperature", add_note);
  if (run.has_load) measurement.load_unit = rows.load_unit;
  take_torques_as_forces(declared, measurement);
  return measurement;
}

joint::BenchLog bench_log(const Measurement& measurement) {
  joint::BenchLog log;
  for (const Run& run : measurement.runs) {
    joint::BenchRun& into = log.emplace_back();
    into.has_load = run.has_load;
    into.has_temperature = run.has_temperature;
    into.mounting = run.mounting;
    into.rows.reserve(run.samples.size());
    for (const Sample& sample : run.samples)
      into.rows.push_back({sample.time, sample.alpha, sample.load, sample.temperature_C});
  }
  return log;
}

}  // namespace fusee::measurement
