#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "base/text.h"
#include "cli/analysis_table.h"
#include "cli/command.h"
#include "cli/pins.h"
#include "cli/strict.h"
#include "cli/table.h"
#include "cli/under_load.h"
#include "export/report/analysis.h"
#include "export/report/under_load.h"
#include "fusee/base.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

// ---- summary --------------------------------------------------------------------------------------------------------

constexpr std::size_t k_column = 18;  // of the texts, see titled()

std::string line(const std::string& title, const std::string& text) { return titled(title, text, k_column); }

std::string tension_line(const analysis::AnalysisResult& result, const Mechanism& mechanism) {
  const analysis::TensionExtreme& most = result.largest_tension;
  return line("largest tension", rounded(most.tension) + " N, " + analysis::place_words(most, mechanism) + ", " +
                                     alpha_text(most.alpha) + (most.rising ? " and rising" : " and falling")) +
         line("", "(paper: T_b " + rounded(result.largest_paper_tension.value) + " N, " +
                      alpha_text(result.largest_paper_tension.alpha) + ")");
}

std::string strength_line(const analysis::AnalysisResult& result, const Mechanism& mechanism) {
  if (!result.strength) return line("tendon strength", "unknown: set tendon.strength_N");
  const std::string source = result.strength->source == "tendon.strength_N"
                                 ? result.strength->source
                                 : result.strength->source + " of the catalogue";
  const auto factor = result.safety_factor();
  return line("tendon strength", rounded(result.strength->tension) + " N (" + source + ")") +
         line("", rounded(result.strength->at_knot) + " N at a knot (tendon.knot_efficiency)") +
         line("", std::string("its knot ") + (mechanism.joint.is_plain() ? "at C" : "at the joint") +
                      " carries up to " + rounded(result.largest_at_joint.value) + " N") +
         (factor ? line("safety factor", rounded(*factor, 3) + " against breaking") : "");
}

std::string drum_lines(const analysis::AnalysisResult& result) {
  std::string text;
  for (const analysis::DrumHold& hold : result.on_drum)
    text += line(
        text.empty() ? "drum friction" : "",
        "tendon " + std::string(hold.tendon == transmission::Side::left ? "1" : "2") + " over up to " +
            rounded(degrees(hold.wrap)) + " deg: at its end within a factor of " + rounded(hold.ratio) +
            " of its span" +
            (hold.at_end.value > 0 ? ", up to " + rounded(hold.at_end.value) + " N, " + alpha_text(hold.at_end.alpha)
                                   : ", slack"));
  return text;
}

std::string slack_lines(const analysis::AnalysisResult& result) {
  if (result.slack1.empty() && result.slack2.empty()) return line("slack", "none: both tendons stay taut");
  std::string text;
  const std::string remedy = pretension_text(result);
  for (const bool first : {true, false}) {
    const std::vector<analysis::AlphaRange>& ranges = first ? result.slack1 : result.slack2;
    if (ranges.empty()) continue;
    text += line(first ? "tendon 1 slack" : "tendon 2 slack", slack_text(result, ranges));
    if (!remedy.empty()) text += line("", remedy);
  }
  return text;
}

std::string sources_table(const std::vector<analysis::ErrorSource>& sources) {
  std::vector<std::vector<std::string>> cells;
  for (const analysis::ErrorSource& source : sources) {
    cells.push_back({source.meaning, fixed(degrees(source.least), 4), fixed(degrees(source.most), 4),
                     fixed(degrees(source.worst_at), 1)});
  }
  return table({{"theta error from", Align::left},
                {"from_deg", Align::right},
                {"to_deg", Align::right},
                {"at alpha", Align::right}},
               cells);
}

std::string tolerances_table(const std::vector<analysis::ToleranceEffect>& effects) {
  std::vector<std::vector<std::string>> cells;
  for (const analysis::ToleranceEffect& effect : effects) {
    cells.push_back({effect.key, fixed(degrees(effect.theta_by_derivative), 4),
                     fixed(degrees(effect.theta_by_monte_carlo), 4), fixed(degrees(effect.theta_at), 1),
                     fixed(effect.excess_by_derivative, 4), fixed(effect.excess_by_monte_carlo, 4)});
  }
  return table({{"tolerance of", Align::left},
                {"theta_deg", Align::right},
                {"sampled", Align::right},
                {"at alpha", Align::right},
                {"excess2_mm", Align::right},
                {"sampled", Align::right}},
               cells);
}

std::string summary(const analysis::AnalysisResult& result, const analysis::AnalysisOptions& options,
                    const Mechanism& mechanism) {
  std::string text = "Summary\n" + tension_line(result, mechanism) + strength_line(result, mechanism) +
                     drum_lines(result) + slack_lines(result);
  text += line("motor torque",
               "up to " + rounded(result.largest_torque.value) + " Nmm, " + alpha_text(result.largest_torque.alpha));
  text += line("hysteresis", "up to " + rounded(degrees(result.hysteresis.value), 3) + " deg between directions, " +
                                 alpha_text(result.hysteresis.alpha));
  text += line("theta error", "up to " + rounded(degrees(result.theta_error.value), 3) + " deg, " +
                                  alpha_text(result.theta_error.alpha));
  text += motor_lines(result, k_column);
  text += "\nError budget\n" + sources_table(result.sources);
  text += "\nTolerances: each dimension within " + shortest(options.dimension_tolerance) +
          " mm (95 %), and the resulting\nlimits of theta and of the excess length of tendon 2\n" +
          tolerances_table(result.tolerances);
  return text;
}

// ---- JSON -----------------------------------------------------------------------------------------------------------

Json ranges_json(const std::vector<analysis::AlphaRange>& ranges) {
  Json list = Json::array();
  for (const analysis::AlphaRange& range : ranges) list.push_back({degrees(range.from), degrees(range.to)});
  return list;
}

Json optional_json(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json summary_json(const analysis::AnalysisResult& result) {
  const analysis::TensionExtreme& most = result.largest_tension;
  Json json;
  json["largest_tension"] = {{"value_N", most.tension},
                             {"alpha_deg", degrees(most.alpha)},
                             {"tendon", most.tendon == transmission::Side::left ? 1 : 2},
                             {"place", most.below_pin ? "below_pin" : "above_pin"},
                             {"direction", most.rising ? "rising" : "falling"}};
  json["largest_paper_Tb"] = {{"value_N", result.largest_paper_tension.value},
                              {"alpha_deg", degrees(result.largest_paper_tension.alpha)}};
  json["strength"] = result.strength ? Json{{"value_N", result.strength->tension},
                                            {"at_knot_N", result.strength->at_knot},
                                            {"source", result.strength->source}}
                                     : Json();
  json["largest_at_joint_knot"] = {{"value_N", result.largest_at_joint.value},
                                   {"alpha_deg", degrees(result.largest_at_joint.alpha)}};
  for (const analysis::DrumHold& hold : result.on_drum)
    json["on_drum"].push_back({{"tendon", hold.tendon == transmission::Side::left ? 1 : 2},
                               {"wrap_deg", degrees(hold.wrap)},
                               {"ratio", hold.ratio},
                               {"largest_at_end_N", hold.at_end.value},
                               {"alpha_deg", degrees(hold.at_end.alpha)}});
  json["slack1_alpha_deg"] = ranges_json(result.slack1);
  json["slack2_alpha_deg"] = ranges_json(result.slack2);
  json["taut_pretension_N"] = optional_json(result.taut_pretension);
  json["largest_motor_torque"] = {{"value_Nmm", result.largest_torque.value},
                                  {"alpha_deg", degrees(result.largest_torque.alpha)}};
  json["hysteresis"] = {{"value_deg", degrees(result.hysteresis.value)},
                        {"alpha_deg", degrees(result.hysteresis.alpha)}};
  json["theta_error"] = {{"value_deg", degrees(result.theta_error.value)},
                         {"alpha_deg", degrees(result.theta_error.alpha)}};
  json["safety_factor"] = optional_json(result.safety_factor());
  return json;
}

Json sources_json(const std::vector<analysis::ErrorSource>& sources) {
  Json list = Json::array();
  for (const analysis::ErrorSource& source : sources) {
    list.push_back({{"name", source.name},
                    {"meaning", source.meaning},
                    {"theta_deg", {degrees(source.least), degrees(source.most)}},
                    {"worst_at_alpha_deg", degrees(source.worst_at)}});
  }
  return list;
}

Json tolerances_json(const std::vector<analysis::ToleranceEffect>& effects) {
  Json list = Json::array();
  for (const analysis::ToleranceEffect& effect : effects) {
    list.push_back({{"key", effect.key},
                    {"theta_deg",
                     {{"derivative", degrees(effect.theta_by_derivative)},
                      {"monte_carlo", degrees(effect.theta_by_monte_carlo)},
                      {"alpha_deg", degrees(effect.theta_at)}}},
                    {"slack2_mm",
                     {{"derivative", effect.excess_by_derivative},
                      {"monte_carlo", effect.excess_by_monte_carlo},
                      {"alpha_deg", degrees(effect.excess_at)}}}});
  }
  return list;
}

// ---- findings -------------------------------------------------------------------------------------------------------

void add_findings(const analysis::AnalysisResult& result, const std::string& file, Reply& reply) {
  const auto report = [&](Severity severity, const std::string& message, const std::string& hint) {
    Diagnostic diagnostic = about_file(severity, file, message);
    diagnostic.hint = hint;
    reply.diagnostics.push_back(diagnostic);
    if (severity == Severity::error) reply.exit = Exit::check_failed;
  };
  if (const auto lost = analysis::no_equilibrium(result)) report(lost->severity, lost->message, lost->hint);
  if (result.breaks_at) {
    const auto breaks = analysis::tendon_breaks({result.largest_tension, result.largest_at_joint}, *result.strength);
    report(breaks->severity, breaks->message, breaks->hint);
  }
  // Without pretension and load no tendon ever has a tension: the file declares a slack joint.
  const bool is_declared_slack = result.largest_tension.tension < 1e-6;  // N
  if (!result.untensioned.empty()) {
    report(is_declared_slack ? Severity::warning : Severity::error,
           "both tendons are slack " + slack_text(result, result.untensioned) + ": nothing holds the joint",
           result.taut_pretension ? "tendon.pretension_N >= " + rounded(*result.taut_pretension, 3) + " keeps both taut"
                                  : "raise tendon.pretension_N");
  }
  for (const profile::Condition& condition : result.obstacles) {
    report(Severity::warning, "forces are known, but the pulley is infeasible: " + condition.message,
           "'fusee build' lists helpful changes");
  }
}

analysis::AnalysisOptions analysis_options_from(const Arguments& arguments) {
  analysis::AnalysisOptions options;
  options.steps = static_cast<int>(arguments.number("--steps", options.steps, 2, 2000, "(steps)"));
  options.dimension_tolerance = arguments.number("--tolerance-mm", options.dimension_tolerance, 0.0, 10.0, "mm");
  options.samples = static_cast<int>(arguments.number("--samples", options.samples, 10, 100000, "(samples)"));
  options.seed = static_cast<std::uint64_t>(arguments.number("--seed", 1, 0, k_largest_seed, "(a whole number)"));
  return options;
}

constexpr auto k_endings = std::to_array<std::string_view>({".csv", ".json", ".html", ".svg", ".png", ".pdf"});

std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// Throws UsageError. Called before the analysis, which takes some time.
void refuse_unknown_ending(const Arguments& arguments) {
  const std::optional<std::string> file = arguments.text("--out");
  if (!file || std::find(k_endings.begin(), k_endings.end(), ending_of(*file)) != k_endings.end()) return;
  throw UsageError("analyze cannot write '" + *file + "': its ending is unknown",
                   "use .csv or .json for the table, .html for a page, .svg, .png or .pdf for the plots");
}

std::string bytes_for(const std::string& ending, const MechanismFile& mechanism, const analysis::AnalysisResult& result,
                      const analysis::AnalysisOptions& options, const Reply& reply) {
  if (ending == ".json") return json_text(stroke_json(result.rows), 1);
  if (ending == ".html") return formats::analysis_html(mechanism, result, options, reply.diagnostics);
  if (ending == ".svg") return formats::analysis_svg(mechanism, result);
  if (ending == ".png") return formats::analysis_png(mechanism, result);
  if (ending == ".pdf") return formats::analysis_pdf(mechanism, result);
  return stroke_csv(result.rows);
}

void write_result(const Arguments& arguments, const MechanismFile& mechanism, const analysis::AnalysisResult& result,
                  const analysis::AnalysisOptions& options, FileAccess& files, Reply& reply) {
  const std::optional<std::string> file = arguments.text("--out");
  if (!file) return;
  const std::string bytes = bytes_for(ending_of(*file), mechanism, result, options, reply);
  if (!arguments.has("--dry-run")) write_file(*file, bytes, arguments.has("--force"), files);
  reply.fields["output"] = *file;
}

Reply run_analyze(const Arguments& arguments, Console& console, const RunContext& context) {
  refuse_unknown_ending(arguments);
  const analysis::AnalysisOptions options = analysis_options_from(arguments);
  const MechanismFile file = read_mechanism(arguments.positionals().front(), arguments.settings(), *context.files);
  Reply reply;
  reply.diagnostics = file.warnings;
  reply.units = file.mechanism.units;
  const analysis::AnalysisResult result = pipeline::analyze(file, options, context);
  reply.diagnostics.insert(reply.diagnostics.end(), result.warnings.begin(), result.warnings.end());
  if (!result.exists) {
    reply.exit = Exit::infeasible;
    add_obstacles(file.path, result.obstacles, reply);
    add_advice(file.path, result.advice, reply);
    add_layout_advice(file.path, result.layout_advice, reply);
    reply.fields["conditions"] = to_json(result.obstacles);
    reply.fields["advice"] = to_json(result.advice);
    return reply;
  }
  add_pins_note(file, reply);
  add_findings(result, file.path, reply);
  if (result.motor && result.motor->enforced && !result.motor->ok()) reply.exit = Exit::infeasible;
  write_result(arguments, file, result, options, *context.files, reply);
  const bool csv = arguments.has("--csv");
  reply.text = csv ? stroke_csv(result.rows)
                   : file.mechanism.name + "\n\n" + stroke_tables(result.rows, console.verbose()) + "\n" +
                         summary(result, options, file.mechanism);
  reply.fields["name"] = file.mechanism.name;
  reply.fields["summary"] = summary_json(result);
  if (result.motor) reply.fields["motor"] = formats::motor_json(*result.motor);
  reply.fields["error_budget"] = sources_json(result.sources);
  reply.fields["tolerances"] = tolerances_json(result.tolerances);
  reply.fields["rows"] = stroke_json(result.rows);
  apply_strict(arguments, reply);
  return reply;
}

}  // namespace

Command analyze_command() {
  return {"analyze",
          "SPEC",
          "the transmission and the forces over the range",
          "Shows angles, radii, tensions, torque, stretch and stiffness over the range of\n"
          "the mechanism file SPEC: by the paper's formulas, and also by the full\n"
          "model of two elastic tendons with pretension, friction at the pins and in the\n"
          "grooves, in its third cycle, with alpha growing. The summary has the largest\n"
          "forces, the slack, and the causes of an error of the joint angle. At the ends\n"
          "of the range the motion reverses: there both directions show the same state.",
          {{"-o,--out", "FILE",
            "write FILE: plots if it ends in .svg, .png or\n.pdf, a page if in .html, the table if in .csv\nor .json"},
           {"--csv", "", "the table as CSV on stdout"},
           {"--steps", "N", "steps of the table (default 60)"},
           {"--tolerance-mm", "MM", "tolerance of every dimension (default 0.1)"},
           {"--samples", "N", "Monte Carlo samples (default 1000)"},
           {"--seed", "N", "random seed of the samples (default 1)"},
           strict_option()},
          {{"fusee analyze arm.toml", "tables and summary"},
           {"fusee analyze arm.toml --set load.tip_force_N=10", "what would a load of 10 N do?"},
           {"fusee analyze arm.toml -o arm.html", "a page on which the joint moves"},
           {"fusee analyze arm.toml -o arm.svg", "its plots as a picture"},
           {"fusee analyze arm.toml --csv > stroke.csv", "every row and every column, for a plot"}},
          run_analyze};
}

}  // namespace fusee::cli
