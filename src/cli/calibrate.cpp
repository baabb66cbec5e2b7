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
      throw UsageError("--column takes role=name; '" + text + "' is not of that form",
                       "for example: --column load=tau_out_Nm");
    }
    const std::string role = text.substr(0, equals);
    if (std::find(roles.begin(), roles.end(), role) == roles.end()) {
      const std::string nearest = nearest_word(role, roles);
      throw UsageError("--column: there is no role '" + role + "'",
                       nearest.empty() ? "roles: alpha, theta, time, load, temperature, tension1, tension2, cycle"
                                       : "did you mean '" + nearest + "'?");
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
  if (files.fitted == 0)
    throw UsageError("every run is held out: none is left to fit", "leave --hold-out away for one of them");
  return files;
}

// ---- what is answered -----------------------------------------------------------------------------------------------

/// Characters of UTF-8 text: every byte that does not continue one.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Words broken into lines of the terminal's usual width.
std::string wrapped(const std::string& words, const std::string& indent) {
  std::string text, line = indent;
  std::size_t at = 0;
  while (at < words.size()) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string word = words.substr(at, end - at);
    if (line.size() > indent.size() && characters(line) + 1 + characters(word) > k_width) {
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

std::string items(const std::string& title, const std::vector<std::string>& all) {
  std::string text = all.empty() ? "" : "\n" + title + "\n";
  for (const std::string& one : all) text += item(one);
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string deg(double value) { return fixed(degrees(value), 4); }

std::string figures_table(const Calibration& c) {
  const auto row = [](const std::string& name, double before, double after) {
    return std::vector<std::string>{name, deg(before), deg(after)};
  };
  return table(
      {{"deg at the joint"}, {"before", Align::right}, {"after", Align::right}},
      {row("  rms", c.before.rms, c.after.rms), row("  largest", c.before.max, c.after.max),
       row("  rms held out", c.before.held_out_rms, c.after.held_out_rms),
       row("  ISO 230-2 A", c.iso_before.A, c.iso_after.A), row("  ISO 230-2 R", c.iso_before.R, c.iso_after.R),
       row("  ISO 230-2 B", c.iso_before.B, c.iso_after.B), row("  ISO 230-2 E", c.iso_before.E, c.iso_after.E),
       row("  ISO 230-2 M", c.iso_before.M, c.iso_after.M)});
}

std::string noise_text(const Calibration& c) {
  std::string words =
      "noise floor " + deg(c.noise.rms) + (c.noise.from_repeats ? " deg, from repeats" : " deg or more: no repeats");
  if (c.noise.rms > 0) words += "; what is left is " + rounded(c.after.rms / c.noise.rms, 3) + " times that";
  return wrapped(words, "  ");
}

std::string effect_text(const FoundEffect& effect, const std::string& load_unit) {
  std::string words = effect.name + " (" + effect.place + ")";
  for (std::size_t i = 0; i < effect.parameters.size(); ++i)
    words += (i == 0 ? ": " : "; ") + parameter_words(effect.parameters[i], load_unit);
  words += ". Takes " + deg(effect.rms_drop) + " deg rms off";
  const std::vector<std::string> rivals = rivals_of(effect);
  return words + (rivals.empty() ? "; nothing else does as well" : "; as good: " + joined(rivals));
}

std::vector<std::string> effect_texts(const Calibration& c, const std::string& load_unit) {
  std::vector<std::string> texts;
  for (const FoundEffect& effect : c.effects) texts.push_back(effect_text(effect, load_unit));
  if (texts.empty()) texts.push_back("none accepted");
  if (!c.unexplained_where.empty())
    texts.push_back("unexplained: " + deg(c.unexplained_rms) + " deg rms, " + c.unexplained_where);
  return texts;
}

std::string tied_words(const Correction& correction) {
  return "tie its tendons with the unloaded joint at home and the motor at " + rounded(degrees(correction.tied_at), 4) +
         " deg: under its mean load the joint then follows its law; tied at 0 it is off by as much, which compensation.csv has";
}

std::vector<std::string> correction_texts(const Correction& correction) {
  std::vector<std::string> texts;
  if (correction.has_pulley) {
    texts.push_back("the pulley of corrected.toml takes away " + deg(correction.by_pulley) + " deg rms");
    if (correction.round.r1 > 0) texts.push_back(round_words(correction));
    if (correction.tied_at != 0) texts.push_back(tied_words(correction));
  } else if (!correction.infeasible.empty()) {
    texts.push_back("the pulley that would correct this cannot be made: " + correction.infeasible);
  } else {
    texts.push_back("nothing was identified that another pulley would take out");
  }
  if (!correction.table.empty())
    texts.push_back("compensation.csv takes away " + deg(correction.by_table) + " deg rms" +
                    (correction.has_pulley ? " beyond that" : ""));
  return texts;
}

std::vector<std::string> detectable_texts(const Calibration& c) {
  std::vector<std::string> texts;
  for (const auto& [size, names] : detectable_groups(c)) texts.push_back(deg(size) + " deg: " + joined(names));
  return texts;
}

std::string tried_table(const Calibration& c) {
  if (c.tried.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const Candidate& candidate : c.tried) {
    rows.push_back({"  " + candidate.name, deg(candidate.held_out_rms), fixed(candidate.margin, 1),
                    fixed(candidate.delta_bic, 1), candidate.accepted ? "taken" : ""});
  }
  return "\n" + table({{"Tried, in this order"},
                       {"deg held out", Align::right},
                       {"margin", Align::right},
                       {"BIC drop", Align::right},
                       {""}},
                      rows);
}

std::string summary(const CalibrationProduct& product, bool verbose) {
  const Calibration& c = product.calibration;
  std::string text = product.file.mechanism.name + ": " + c.verdict + "\n" + wrapped(c.summary, "  ");
  if (c.verdict == "not_testable") return text + items("Measure next", c.next_runs);
  text += "\n" + figures_table(c) + noise_text(c) + items("Effects", effect_texts(c, product.measurement.load_unit));
  text += items("Cannot be told apart by these data", c.null_combinations) +
          items("Correction", correction_texts(product.correction)) + items("Measure next", c.next_runs);
  if (verbose || c.verdict == "no_effect")
    text += items("Would have been seen, at the joint, rms", detectable_texts(c));
  return verbose ? text + tried_table(c) : text;
}

// ---- what is left behind --------------------------------------------------------------------------------------------

/// corrected.toml lies elsewhere: the table of law = "table" goes with it, under its own name.
void add_law_table(const MechanismFile& file, std::string& corrected, std::vector<OutputFile>& outputs) {
  const PulleyDrive& pulley = file.mechanism.pulley;
  if (file.mechanism.transmission || pulley.law != Law::table) return;
  const std::filesystem::path table(pulley.table);
  const std::string name = table.filename().string();
  if (const std::size_t at = corrected.find("\"" + pulley.table + "\""); at != std::string::npos)
    corrected.replace(at + 1, pulley.table.size(), name);
  outputs.push_back({name, read_file(std::filesystem::path(file.path).parent_path() / table, k_largest_law)});
}

/// The text that corrected.toml begins with: the person's own, or every key where --set gave others than stand there.
std::string declared_text(const Arguments& arguments, const MechanismFile& file) {
  return arguments.settings().empty() ? read_file(file.path, k_largest_spec) : write_mechanism(file.mechanism);
}

std::vector<OutputFile> outputs_of(const CalibrationProduct& product, const std::string& declared) {
  std::vector<OutputFile> outputs;
  outputs.push_back({"calibration.json", calibration_json(product)});
  std::string corrected = corrected_toml(declared, product.file.mechanism, product.calibration, product.correction);
  add_law_table(product.file, corrected, outputs);
  outputs.push_back({"corrected.toml", corrected});
  outputs.push_back({"compensation.csv", compensation_csv(product.correction)});
  outputs.push_back({"report.html", calibration_report_html(product)});
  outputs.push_back({"manifest.json", calibration_manifest_json(product, outputs)});
  return outputs;
}

std::vector<std::string> output_names(const MechanismFile& file) {
  std::vector<std::string> names = {"calibration.json", "corrected.toml", "compensation.csv", "report.html",
                                    "manifest.json"};
  const PulleyDrive& pulley = file.mechanism.pulley;
  if (!file.mechanism.transmission && pulley.law == Law::table)
    names.push_back(std::filesystem::path(pulley.table).filename().string());
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

Calibration calibration_of(const Mechanism& mechanism, const Measurement& measurement, std::size_t fitted,
                           Console& console) {
  CalibrationOptions options;
  for (std::size_t i = fitted; i < measurement.runs.size(); ++i) options.hold_out.push_back(measurement.runs[i].name);
  options.progress = [&console](const std::string& what, double share) { console.progress(progress_bar(share) + ", " + what); };
  return calibrate(mechanism, measurement, options);
}

/// A torque is not a tip force: the elastic model of tendons takes N across OC.
void convert_load(const Mechanism& mechanism, Measurement& measurement) {
  const double per_newton = measurement.load_unit == "Nm"    ? 1000.0 / mechanism.joint.R
                            : measurement.load_unit == "Nmm" ? 1.0 / mechanism.joint.R
                                                             : 0.0;
  if (mechanism.transmission || per_newton == 0) return;
  for (Run& run : measurement.runs) {
    for (Sample& sample : run.samples) sample.load *= per_newton;
    run.mean_load *= per_newton;
  }
  measurement.notes.push_back("the load column holds a torque in " + measurement.load_unit +
                              ": taken as a tip force across OC, positive against +theta");
  measurement.load_unit = "N";
}

std::string files_text(const std::vector<OutputFile>& outputs, const std::string& folder, bool published) {
  std::vector<std::vector<std::string>> rows;
  for (const OutputFile& file : outputs) rows.push_back({"  " + file.name, std::to_string(file.bytes.size()) + " B"});
  return "\n" + table({{published ? "Files" : "Would be written (--dry-run)"}, {"", Align::right}}, rows) + "  in " +
         folder + "\n";
}

Json outputs_json(const std::vector<OutputFile>& outputs) {
  Json list = Json::array();
  for (const OutputFile& file : outputs)
    list.push_back({{"file", file.name}, {"bytes", file.bytes.size()}, {"sha256", sha256(file.bytes)}});
  return list;
}

void add_notes(const CalibrationProduct& product, bool verbose, Reply& reply) {
  const std::vector<std::string>& notes = product.measurement.notes;
  reply.diagnostics = product.file.warnings;
  for (const std::string& words : verbose ? notes : shortened_notes(notes))
    reply.diagnostics.push_back(note(Severity::note, words));
}

/// What is looked for is what is still amiss: a corrected file describes the joint as it is.
CalibrationProduct product_of(const Files& files, const MeasurementOptions& columns, MechanismFile file,
                              Console& console) {
  CalibrationProduct product;
  product.file = std::move(file);
  const Mechanism& declared = product.file.mechanism;
  console.progress("reading the runs");
  product.measurement = read_measurement(files.all, columns);
  const Mechanism expected = expected_joint(declared);
  compare_with_declared(expected, product.measurement);
  convert_load(expected, product.measurement);
  product.calibration = calibration_of(expected, product.measurement, files.fitted, console);
  console.progress("working out the correction");
  product.correction.identified = declared.identified;
  if (product.calibration.verdict != "not_testable")
    product.correction = correct(declared, product.measurement, product.calibration);
  return product;
}

Reply run_calibrate(const Arguments& arguments, Console& console) {
  const std::filesystem::path spec = arguments.positionals().front();
  const MeasurementOptions columns = columns_from(arguments);
  const Files files = files_from(arguments);
  MechanismFile file = read_mechanism(spec, arguments.settings());
  const std::string folder =
      arguments.text("--out").value_or(("out" / std::filesystem::path(spec.stem().string() + "_calibration")).string());
  OutputFolder target(folder, arguments.has("--force"));
  target.claim(output_names(file));  // before the work: a refusal should not cost a wait
  const std::string declared = declared_text(arguments, file);

  const CalibrationProduct product = product_of(files, columns, std::move(file), console);
  const std::vector<OutputFile> outputs = outputs_of(product, declared);
  const bool published = !arguments.has("--dry-run");
  if (published) publish(target, outputs);
  Reply reply;
  add_notes(product, console.verbose(), reply);
  if (!arguments.settings().empty())
    reply.diagnostics.push_back(
        note(Severity::note,
             "corrected.toml holds what --set gave, and so every key; the comments of the file are left out"));
  reply.text = summary(product, console.verbose()) + files_text(outputs, folder, published);
  reply.fields = Json::parse(calibration_json(product));
  reply.fields["folder"] = folder;
  reply.fields["published"] = published;
  reply.fields["outputs"] = outputs_json(outputs);
  return reply;
}

}  // namespace

Command calibrate_command() {
  return {"calibrate",
          "SPEC RUN.csv...",
          "measured data: what is off, why, a better pulley",
          "Holds measured runs of a joint (CSV with alpha_deg,theta_deg and, if logged,\n"
          "time_s,load_N,temperature_C) against the mechanism file SPEC: finds the residual,\n"
          "names the effects behind it that hold on data they were not fitted to, with those\n"
          "that would do as well, and leaves corrected.toml (fusee build makes its pulley),\n"
          "compensation.csv (where the motor must stand, from below and from above),\n"
          "calibration.json and report.html. Whatever the verdict, also not_testable, the\n"
          "exit code is 0 when the data could be read and 3 when they could not.",
          {{"-o,--out", "DIR", "where the files go\n(default: out/<name of SPEC>_calibration)"},
           {"--hold-out", "FILE", "a run to validate with only; may be given several times", true},
           {"--column", "ROLE=NAME",
            "the column of a role: alpha, theta, time, load,\ntemperature …; may be given several times", true}},
          {{"fusee calibrate arm.toml run_1.csv run_2.csv", "files in out/arm_calibration; open its report.html"},
           {"fusee calibrate arm.toml run_1.csv --hold-out run_2.csv", "judge by run_2.csv alone"},
           {"fusee calibrate jaw.toml jaw.csv --column load=tau_out_Nm", "the load has another name"}},
          run_calibrate};
}

}  // namespace fusee::cli
