#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/table.h"
#include "fusee/base/text.h"
#include "fusee/calibration/words.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

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

std::vector<std::filesystem::path> paths(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

std::vector<std::filesystem::path> runs_from(const Arguments& arguments) {
  std::vector<std::filesystem::path> runs = paths(arguments.positionals());
  runs.erase(runs.begin());
  std::set<std::filesystem::path> held;
  for (const auto& name : paths(arguments.texts("--hold-out"))) held.insert(name.lexically_normal());
  if (std::all_of(runs.begin(), runs.end(), [&](const auto& run) { return held.count(run.lexically_normal()) > 0; }))
    throw UsageError("every run is held out: none is left to fit", "leave --hold-out away for one of them");
  return runs;
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
  std::string words = effect.name + " (" + std::string(word(effect.place)) + ")";
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

std::vector<std::string> correction_texts(const Correction& correction) {
  std::vector<std::string> texts;
  if (correction.has_pulley) {
    texts.push_back("the pulley of corrected.toml takes away " + deg(correction.by_pulley) + " deg rms");
    if (correction.round.r1 > 0) texts.push_back(round_words(correction));
    if (correction.tied_at != 0) texts.push_back(tied_words(correction));
  } else if (!correction.infeasible.empty()) {
    texts.push_back(infeasible_words(correction));
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
  std::string text = product.file.mechanism.name + ": " + std::string(word(c.verdict)) + "\n" + wrapped(c.summary, "  ");
  if (c.verdict == CalibrationVerdict::not_testable) return text + items("Measure next", c.next_runs);
  text += "\n" + figures_table(c) + noise_text(c) + items("Effects", effect_texts(c, product.measurement.load_unit));
  text += items("Cannot be told apart by these data", c.null_combinations) +
          items("Correction", correction_texts(product.correction)) + items("Measure next", c.next_runs);
  if (verbose || c.verdict == CalibrationVerdict::no_effect)
    text += items("Would have been seen, at the joint, rms", detectable_texts(c));
  return verbose ? text + tried_table(c) : text;
}

// ---- the whole ------------------------------------------------------------------------------------------------------

/// A bar of 20 places on the progress line.
std::string bar(const std::string& what, double share) {
  const int percent = static_cast<int>(100 * std::clamp(share, 0.0, 1.0));
  const auto full = static_cast<std::size_t>(percent / 5);
  return "[" + std::string(full, '#') + std::string(20 - full, '.') + "] " + std::to_string(percent) + " %, " + what;
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

void add_notes(const CalibrateResult& result, bool verbose, Reply& reply) {
  const std::vector<std::string>& notes = result.product.measurement.notes;
  reply.diagnostics = result.product.file.warnings;
  for (const std::string& words : verbose ? notes : shortened_notes(notes))
    reply.diagnostics.push_back(note(Severity::note, words));
  if (result.rewritten)
    reply.diagnostics.push_back(
        note(Severity::note,
             "corrected.toml holds what --set gave, and so every key; the comments of the file are left out"));
}

CalibrateOptions options_from(const Arguments& arguments, const std::filesystem::path& spec, Console& console) {
  CalibrateOptions options;
  options.columns = columns_from(arguments);
  options.hold_out = paths(arguments.texts("--hold-out"));
  options.folder =
      arguments.text("--out").value_or(("out" / std::filesystem::path(spec.stem().string() + "_calibration")).string());
  options.force = arguments.has("--force");
  options.dry_run = arguments.has("--dry-run");
  options.progress = [&console](const std::string& what, std::optional<double> share) {
    console.progress(share ? bar(what, *share) : what);
  };
  return options;
}

Reply run_calibrate(const Arguments& arguments, Console& console) {
  const std::filesystem::path spec = arguments.positionals().front();
  CalibrateOptions options = options_from(arguments, spec, console);
  const std::vector<std::filesystem::path> runs = runs_from(arguments);
  const MechanismFile file = read_mechanism(spec, arguments.settings());
  std::optional<InterruptsDeferred> writing;
  options.before_writing = [&writing] {
    if (!writing) writing.emplace();
    stop_if_interrupted();
  };
  const CalibrateResult result = calibrate(file, runs, options);
  writing.reset();
  Reply reply;
  add_notes(result, console.verbose(), reply);
  reply.text = summary(result.product, console.verbose()) +
               files_text(result.outputs, options.folder.string(), result.published);
  reply.fields = Json::parse(calibration_json(result.product));
  reply.fields["folder"] = options.folder.string();
  reply.fields["published"] = result.published;
  reply.fields["outputs"] = outputs_json(result.outputs);
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
