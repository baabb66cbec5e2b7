#include <algorithm>
#include <filesystem>
#include <set>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/table.h"
#include "fusee/base/files.h"
#include "fusee/base/text.h"
#include "fusee/export/calibration.h"

namespace fusee::cli {
namespace {

constexpr std::size_t k_largest_spec = 1 << 20;
constexpr std::size_t k_largest_law = 8 << 20;
constexpr std::size_t k_width = 78;

// ---- what is asked --------------------------------------------------------------------------------------------------

MeasurementOptions columns_from(const Arguments& arguments) {
  MeasurementOptions options;
  std::vector<std::string> roles;
  for (const auto& [role, column] : column_roles()) roles.push_back(role);
  for (const std::string& text : arguments.texts("--column")) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
      throw UsageError("--column takes role=name; '" + text + "' is not of that form", "for example: --column load=tau_out_Nm");
    }
    const std::string role = text.substr(0, equals);
    if (std::find(roles.begin(), roles.end(), role) == roles.end()) {
      const std::string nearest = nearest_word(role, roles);
      throw UsageError("--column: there is no role '" + role + "'",
                       nearest.empty() ? "roles: alpha, theta, time, load, temperature, tension1, tension2, cycle" : "did you mean '" + nearest + "'?");
    }
    options.columns[role] = text.substr(equals + 1);
  }
  return options;
}

/// Measured runs and those held out; a file named twice is read once.
struct Files {
  std::vector<std::filesystem::path> all;
  std::size_t fitted = 0;  ///< the first ones; the others are held out
};

Files files_from(const Arguments& arguments) {
  Files files;
  const std::vector<std::string> held = arguments.texts("--hold-out");
  std::set<std::filesystem::path> seen;
  const auto key = [](const std::string& name) { return std::filesystem::path(name).lexically_normal(); };
  for (const std::string& name : held) seen.insert(key(name));
  for (std::size_t i = 1; i < arguments.positionals().size(); ++i) {
    if (seen.insert(key(arguments.positionals()[i])).second) files.all.emplace_back(arguments.positionals()[i]);
  }
  files.fitted = files.all.size();
  seen.clear();
  for (const std::string& name : held) {
    if (seen.insert(key(name)).second) files.all.emplace_back(name);
  }
  if (files.fitted == 0) throw UsageError("every run is held out: none is left to fit", "leave --hold-out away for one of them");
  return files;
}

// ---- what is answered -----------------------------------------------------------------------------------------------

/// Words broken into lines of the terminal's usual width.
std::string wrapped(const std::string& words, const std::string& indent) {
  std::string text, line = indent;
  std::size_t at = 0;
  while (at < words.size()) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string word = words.substr(at, end - at);
    if (line.size() > indent.size() && line.size() + 1 + word.size() > k_width) {
      text += line + "\n";
      line = indent;
    }
    line += (line.size() > indent.size() ? " " : "") + word;
    at = end + 1;
  }
  return text + line + "\n";
}

std::string item(const std::string& words) {
  std::string text = wrapped(words, "    ");
  text.replace(0, 4, "  - ");
  return text;
}

std::string deg(double value) { return fixed(degrees(value), 4); }

std::string figures_table(const Calibration& c) {
  const auto row = [](const std::string& name, double before, double after) { return std::vector<std::string>{name, deg(before), deg(after)}; };
  return table({{"deg at the joint", Align::left}, {"before", Align::right}, {"after", Align::right}},
               {row("  rms", c.before.rms, c.after.rms), row("  largest", c.before.max, c.after.max), row("  rms held out", c.before.held_out_rms, c.after.held_out_rms),
                row("  ISO 230-2 A", c.iso_before.A, c.iso_after.A), row("  ISO 230-2 R", c.iso_before.R, c.iso_after.R), row("  ISO 230-2 B", c.iso_before.B, c.iso_after.B),
                row("  ISO 230-2 E", c.iso_before.E, c.iso_after.E), row("  ISO 230-2 M", c.iso_before.M, c.iso_after.M)});
}

std::string effect_text(const FoundEffect& effect) {
  std::string words = effect.name + " (" + effect.place + ")";
  for (const FittedParameter& parameter : effect.parameters) {
    words += ", " + parameter.name + " = " + rounded(parameter.value) + " [" + rounded(parameter.low) + ", " + rounded(parameter.high) + "]";
  }
  words += "; rms falls by " + deg(effect.rms_drop) + " deg";
  std::string rivals;
  for (const std::string& rival : effect.group) {
    if (rival != effect.name) rivals += (rivals.empty() ? "" : ", ") + rival;
  }
  return words + (rivals.empty() ? "" : "; as good: " + rivals);
}

std::string round_text(const RoundChoice& round) {
  if (round.suffices) return "P1 stays round, r1 = " + rounded(round.r1, 5) + " mm: within " + deg(round.max_error) + " deg";
  return "P1 is shaped: round (best r1 " + rounded(round.r1, 5) + " mm) it would miss by up to " + deg(round.max_error) + " deg";
}

std::string tied_text(double tied_at) {
  return "tie the tendons with the unloaded joint at home and the motor at " + rounded(degrees(tied_at), 4) +
         " deg: under its mean load the joint then follows its law; tied at 0 it is off by as much, which compensation.csv has";
}

std::string correction_text(const Correction& correction) {
  std::string text;
  if (!correction.infeasible.empty()) text += item("the pulley that would correct this cannot be made: " + correction.infeasible);
  if (correction.has_pulley) {
    text += item("corrected.toml: its pulley takes away " + deg(correction.by_pulley) + " deg rms");
    if (correction.round.r1 > 0) text += item(round_text(correction.round));
    if (correction.tied_at != 0) text += item(tied_text(correction.tied_at));
  }
  text += item("compensation.csv takes away " + deg(correction.by_table) + " deg rms" + (correction.has_pulley ? " beyond that" : ""));
  return text + item("by simulation the joint misses its law by " + deg(correction.error_now) + " deg rms now, " + deg(correction.error_with_pulley) +
                     " with the pulley, " + deg(correction.error_with_table) + " with the table");
}

std::string summary(const CalibrationProduct& product) {
  const Calibration& c = product.calibration;
  std::string text = product.file.mechanism.name + ": " + c.verdict + "\n" + wrapped(c.summary, "  ") + "\n";
  if (c.verdict == "not_testable") {
    for (const std::string& reason : product.measurement.not_testable) text += item(reason);
    return text;
  }
  text += figures_table(c) + "  noise floor " + deg(c.noise.rms) + (c.noise.from_repeats ? " from repeats" : " at least (no repeats)");
  if (c.noise.rms > 0) text += "; the rest is " + rounded(c.after.rms / c.noise.rms, 3) + " times that";
  text += "\n\nEffects\n";
  for (const FoundEffect& effect : c.effects) text += item(effect_text(effect));
  if (c.effects.empty()) text += "  none accepted\n";
  if (!c.unexplained_where.empty()) text += item("unexplained " + deg(c.unexplained_rms) + " deg rms: " + c.unexplained_where);
  text += "\nCorrection\n" + correction_text(product.correction);
  if (!c.next_runs.empty()) text += "\nMeasure next\n";
  for (const std::string& run : c.next_runs) text += item(run);
  return text;
}

// ---- what is left behind --------------------------------------------------------------------------------------------

/// corrected.toml lies elsewhere: the table of law = "table" goes with it, under its own name.
void add_law_table(const MechanismFile& file, std::string& corrected, std::vector<OutputFile>& outputs) {
  const PulleyDrive& pulley = file.mechanism.pulley;
  if (file.mechanism.transmission || pulley.law != Law::table) return;
  const std::filesystem::path table(pulley.table);
  const std::string name = table.filename().string();
  if (const std::size_t at = corrected.find("\"" + pulley.table + "\""); at != std::string::npos) corrected.replace(at + 1, pulley.table.size(), name);
  outputs.push_back({name, read_file(std::filesystem::path(file.path).parent_path() / table, k_largest_law)});
}

std::vector<OutputFile> outputs_of(const CalibrationProduct& product, const Mechanism& declared, const std::string& spec_text) {
  std::vector<OutputFile> outputs;
  outputs.push_back({"calibration.json", calibration_json(product)});
  std::string corrected = corrected_toml(spec_text, declared, product.calibration, product.correction);
  add_law_table(product.file, corrected, outputs);
  outputs.push_back({"corrected.toml", corrected});
  outputs.push_back({"compensation.csv", compensation_csv(product.correction)});
  outputs.push_back({"report.html", calibration_report_html(product)});
  outputs.push_back({"manifest.json", calibration_manifest_json(product, outputs)});
  return outputs;
}

const std::vector<std::string>& calibration_output_names() {
  static const std::vector<std::string> names = {"calibration.json", "corrected.toml", "compensation.csv", "report.html", "manifest.json"};
  return names;
}

void publish(OutputFolder& folder, const std::vector<OutputFile>& outputs) {
  const InterruptsDeferred deferred;
  for (const OutputFile& file : outputs) {
    stop_if_interrupted();
    folder.stage(file);
  }
  folder.publish();
}

/// Data that were read but cannot be judged.
Calibration without_a_test(const Measurement& measurement) {
  Calibration calibration;
  calibration.verdict = "not_testable";
  calibration.summary = "These data cannot be tested: " + measurement.not_testable.front() + ".";
  if (measurement.not_testable.size() > 1) calibration.summary += " There is more: see the list.";
  for (const Run& run : measurement.runs) {
    calibration.residuals_before.emplace_back(run.samples.size(), 0.0);
    calibration.residuals_after.emplace_back(run.samples.size(), 0.0);
  }
  return calibration;
}

Calibration calibration_of(const Mechanism& mechanism, const Measurement& measurement, std::size_t fitted, Console& console) {
  if (!measurement.not_testable.empty()) return without_a_test(measurement);
  CalibrationOptions options;
  for (std::size_t i = fitted; i < measurement.runs.size(); ++i) options.hold_out.push_back(measurement.runs[i].name);
  options.progress = [&console](const std::string& what, double share) { console.progress(what + " " + fixed(100 * share, 0) + " %"); };
  return calibrate(mechanism, measurement, options);
}

/// A torque is not a tip force: the elastic model of tendons takes N across OC.
void convert_load(const Mechanism& mechanism, Measurement& measurement) {
  const double per_newton = measurement.load_unit == "Nm" ? 1000.0 / mechanism.joint.R : measurement.load_unit == "Nmm" ? 1.0 / mechanism.joint.R : 0.0;
  if (mechanism.transmission || per_newton == 0) return;
  for (Run& run : measurement.runs) {
    for (Sample& sample : run.samples) sample.load *= per_newton;
    run.mean_load *= per_newton;
  }
  measurement.notes.push_back("the load column holds a torque in " + measurement.load_unit + ": taken as a tip force across OC, positive against +theta");
  measurement.load_unit = "N";
}

Reply reply_of(const CalibrationProduct& product, const std::string& folder, bool published) {
  Reply reply;
  reply.diagnostics = product.file.warnings;
  for (const std::string& words : product.measurement.notes) reply.diagnostics.push_back(note(Severity::note, words));
  for (const std::string& words : product.measurement.not_testable) reply.diagnostics.push_back(note(Severity::warning, "not testable: " + words));
  reply.text = summary(product) + "\n" + (published ? "Files in " + folder + "\n" : "No files written (--dry-run)\n");
  reply.fields = Json::parse(calibration_json(product));
  reply.fields["folder"] = folder;
  reply.fields["published"] = published;
  return reply;
}

Reply run_calibrate(const Arguments& arguments, Console& console) {
  const std::filesystem::path spec = arguments.positionals().front();
  const MeasurementOptions columns = columns_from(arguments);
  const Files files = files_from(arguments);
  CalibrationProduct product;
  product.file = read_mechanism(spec, arguments.settings());
  const Mechanism declared = product.file.mechanism;
  const std::string folder = arguments.text("--out").value_or(("out" / std::filesystem::path(spec.stem().string() + "_calibration")).string());
  OutputFolder target(folder, arguments.has("--force"));
  target.claim(calibration_output_names());  // before the work: a refusal should not cost a wait

  console.progress("reading the runs");
  product.measurement = read_measurement(files.all, columns);
  // A corrected file describes the joint as it is; only what is still amiss is looked for.
  const Mechanism expected = expected_joint(declared);
  compare_with_declared(expected, product.measurement);
  convert_load(expected, product.measurement);
  product.calibration = calibration_of(expected, product.measurement, files.fitted, console);
  console.progress("working out the correction");
  if (product.calibration.verdict != "not_testable") {
    product.correction = correct(declared, product.measurement, product.calibration);
  } else {
    product.correction.identified = declared.identified;
  }
  const std::vector<OutputFile> outputs = outputs_of(product, declared, read_file(spec, k_largest_spec));
  const bool published = !arguments.has("--dry-run");
  if (published) publish(target, outputs);
  return reply_of(product, folder, published);
}

}  // namespace

Command calibrate_command() {
  return {"calibrate",
          "SPEC RUN.csv...",
          "measured data: what is off, why, and the pulley for it",
          "Holds measured runs of a joint (CSV with alpha_deg,theta_deg and, if logged,\n"
          "time_s,load_N,temperature_C) against the mechanism file SPEC: finds the residual,\n"
          "names the effects behind it that hold on data they were not fitted to, with those\n"
          "that would do as well, and leaves corrected.toml (fusee build makes its pulley),\n"
          "compensation.csv (where the motor must stand, from below and from above),\n"
          "calibration.json and report.html. Whatever the verdict, also not_testable, the\n"
          "exit code is 0 when the data could be read and 3 when they could not.",
          {{"-o,--out", "DIR", "where the files go\n(default: out/<name of SPEC>_calibration)"},
           {"--hold-out", "FILE", "a run to validate with only; may be given several times", true},
           {"--column", "ROLE=NAME", "the column of a role: alpha, theta, time, load,\ntemperature …; may be given several times", true}},
          {{"fusee calibrate arm.toml run_1.csv run_2.csv", "files in out/arm_calibration; open its report.html"},
           {"fusee calibrate arm.toml run_1.csv --hold-out run_2.csv", "judge by run_2.csv alone"},
           {"fusee calibrate jaw.toml jaw.csv --column load=tau_out_Nm", "the load has another name"}},
          run_calibrate};
}

}  // namespace fusee::cli
