#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/output_list.h"
#include "base/text.h"
#include "cli/as_built.h"
#include "cli/command.h"
#include "cli/pins.h"
#include "cli/strict.h"
#include "cli/table.h"
#include "cli/under_load.h"
#include "export/report/tendon_lengths.h"
#include "export/report/under_load.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

struct Range {
  double least = 0;
  double most = 0;
};

template <typename Value>
Range range_over(const std::vector<transmission::TransmissionPoint>& stroke, Value value) {
  Range range{value(stroke.front()), value(stroke.front())};
  for (const transmission::TransmissionPoint& point : stroke) {
    range.least = std::min(range.least, value(point));
    range.most = std::max(range.most, value(point));
  }
  return range;
}

struct StrokeRanges {
  Range alpha, theta;  ///< deg
  Range r1, r2;        ///< mm
};

StrokeRanges ranges_of(const std::vector<transmission::TransmissionPoint>& stroke) {
  return {range_over(stroke, [](const transmission::TransmissionPoint& point) { return degrees(point.alpha); }),
          range_over(stroke, [](const transmission::TransmissionPoint& point) { return degrees(point.theta); }),
          range_over(stroke, [](const transmission::TransmissionPoint& point) { return point.t1.p; }),
          range_over(stroke, [](const transmission::TransmissionPoint& point) { return point.t2.p; })};
}

std::string range_text(const Range& range, int decimals, const std::string& unit) {
  return "from " + fixed(range.least, decimals) + " to " + fixed(range.most, decimals) + " " + unit;
}

std::string bytes_text(std::size_t bytes) {
  return bytes < 10000 ? std::to_string(bytes) + " B" : std::to_string((bytes + 500) / 1000) + " kB";
}

std::string files_text(const pipeline::BuildResult& built, const pipeline::BuildOptions& options) {
  constexpr std::size_t k_indent = 14, k_name_width = 18, k_size_width = 8;
  if (options.dry_run) return titled("files", "none written (--dry-run)");
  if (!built.published) return titled("files", "none written: " + options.folder.string() + " keeps its earlier run");
  std::string text = titled("files", "in " + options.folder.string());
  for (const OutputFile& file : built.outputs) {
    std::string name = file.name;
    name.resize(k_name_width, ' ');
    const std::string size = bytes_text(file.bytes.size());
    text += std::string(k_indent, ' ') + name + std::string(k_size_width - std::min(k_size_width, size.size()), ' ') +
            size + "\n";
  }
  return text;
}

std::string checks_line(const std::vector<Check>& checks) {
  const auto passed = std::count_if(checks.begin(), checks.end(), [](const Check& check) { return check.ok; });
  return titled("checks", std::to_string(passed) + " of " + std::to_string(checks.size()) + " passed");
}

std::string tendons_text(const formats::Product& product) {
  std::string text;
  for (const formats::TendonLength& tendon : formats::tendon_lengths(product))
    text += (text.empty() ? "cut " : ", ") + std::string(tendon.side == transmission::Side::left ? "1" : "2") + " at " +
            fixed(tendon.cut, 0) + " mm";
  if (text.empty()) return text;
  text = titled("tendons", text + ", with knots and two 50 mm tails");
  if (!product.rig) return text;
  std::string rig;
  for (const formats::KitCut& cut : formats::rig_cuts(product, *product.rig))
    rig += (rig.empty() ? "" : ", ") + std::string(cut.side == transmission::Side::left ? "1" : "2") + " +" +
           fixed(cut.longer, 0) + " mm";
  return text + titled("", rig + " for the test rig of fusee kit");
}

/// Size in the mesh files, which are scaled to allow for the shrinkage of a print; "" if they have the part's size.
std::string mesh_size_text(const solid::BodyLayout& layout, const solid::OuterSize& size) {
  if (layout.scale == 1) return "";
  const std::string larger =
      rounded(100 * std::abs(layout.scale - 1), 3) + (layout.scale > 1 ? " % larger" : " % smaller");
  return titled("", "in the mesh ⌀ " + fixed(size.diameter * layout.scale, 1) + " mm, " +
                        fixed(size.height * layout.scale, 1) + " mm high: " + larger +
                        ", for the shrinkage of the print (material.shrinkage_percent)");
}

std::string size_text(const solid::Pulley& pulley) {
  const solid::OuterSize size = solid::outer_size(pulley);
  const solid::BodyLayout& layout = pulley.layout;
  std::string text = "⌀ " + fixed(size.diameter, 1) + " mm, " + fixed(size.height, 1) + " mm high";
  if (layout.hub_radius > 0) text += "; hub ⌀ " + rounded(2.0 * layout.hub_radius, 3) + " mm";
  if (layout.set_screw.present)
    text += ", set screw " + layout.set_screw.thread + (layout.set_screw.nut_trap ? " and nut" : " (no nut)");
  return titled("size", text) + mesh_size_text(layout, size);
}

std::string knots_text(const solid::Holding& holding) {
  std::string text;
  for (const solid::KnotHold& knot : holding.knots) {
    const std::optional<double> share = holding.share(knot);
    const std::string percent_words = text.empty() ? " % of its strength)" : " %)";
    text += (text.empty() ? "" : ", ") + std::string(knot.side == transmission::Side::left ? "1" : "2") + " up to " +
            rounded(knot.at_knot, 3) + " N" + (share ? " (" + rounded(100.0 * *share, 2) + percent_words : "");
  }
  return text.empty() ? text : titled("knots", text);
}

std::string summary(const pipeline::BuildResult& built, const pipeline::BuildOptions& options, bool verbose) {
  const formats::Product& product = built.product;
  const StrokeRanges ranges = ranges_of(product.synthesis.stroke);
  std::string text = product.joint.mechanism.name + "\n";
  text += titled("alpha", range_text(ranges.alpha, 2, "deg at the pulley"));
  text += titled("theta", range_text(ranges.theta, 2, "deg at the joint"));
  text += titled("r1", range_text(ranges.r1, 3, "mm"));
  text += titled("r2", range_text(ranges.r2, 3, "mm"));
  text += size_text(product.pulley) + tendons_text(product) + knots_text(product.holding);
  text += titled("as built", as_built_text(product.as_built));
  text += under_load_lines(product.under_load, formats::load_words(product.joint.mechanism));
  text += motor_lines(product.under_load);
  text += checks_line(product.checks);
  text += files_text(built, options);
  return verbose ? text + "\n" + checks_table(product.checks) : text;
}

Json range_json(const Range& range) { return {range.least, range.most}; }

Json product_json(const pipeline::BuildResult& built, const pipeline::BuildOptions& options) {
  const formats::Product& product = built.product;
  const StrokeRanges ranges = ranges_of(product.synthesis.stroke);
  Json json;
  json["name"] = product.joint.mechanism.name;
  json["folder"] = options.folder.string();
  json["published"] = built.published;
  json["alpha_deg"] = range_json(ranges.alpha);
  json["theta_deg"] = range_json(ranges.theta);
  json["r1_mm"] = range_json(ranges.r1);
  json["r2_mm"] = range_json(ranges.r2);
  const solid::OuterSize size = solid::outer_size(product.pulley);
  json["size_mm"] = {{"diameter", size.diameter}, {"height", size.height}};
  json["as_built"] = to_json(product.as_built);
  json["under_load"] = formats::under_load_json(product.under_load);
  if (product.under_load.motor) json["motor"] = formats::motor_json(*product.under_load.motor);
  json["checks"] = to_json(product.checks);
  json["outputs"] = output_list(built.outputs);
  return json;
}

/// Adds the reasons why the pulley is infeasible, with places and advice.
void explain_infeasible(const pipeline::BuildResult& built, Reply& reply) {
  const formats::Product& product = built.product;
  const bool has_curves = product.synthesis.made();
  const std::vector<profile::Condition>& conditions =
      has_curves ? product.pulley.conditions : product.synthesis.conditions;
  add_obstacles(product.file.path, conditions, reply);
  add_advice(product.file.path, built.advice.alone, reply, built.advice.is_exhausted);
  add_advice_together(product.file.path, built.advice.together, reply);
  add_layout_advice(product.file.path, built.advice.layout, reply);
  reply.exit = Exit::infeasible;
  reply.fields["conditions"] = to_json(conditions);
  if (product.under_load.motor) reply.fields["motor"] = formats::motor_json(*product.under_load.motor);
  // Numbers and words in separate lists, so that "to" is always a number in the first.
  std::vector<profile::Change> numbers = built.advice.alone, words;
  const auto first_word = std::stable_partition(numbers.begin(), numbers.end(),
                                                [](const profile::Change& change) { return change.to_word.empty(); });
  words.assign(first_word, numbers.end());
  numbers.erase(first_word, numbers.end());
  reply.fields["advice"] = to_json(numbers);
  if (!words.empty()) reply.fields["advice_words"] = to_json(words);
  if (!built.advice.together.empty()) reply.fields["advice_together"] = to_json(built.advice.together);
}

void add_failed_checks(const pipeline::BuildResult& built, const pipeline::BuildOptions& options, Reply& reply) {
  reply.exit = Exit::check_failed;
  add_failures(built.product.checks, reply);
  if (!built.published && !options.dry_run) {
    reply.diagnostics.push_back(
        make_diagnostic(Severity::note, "the files of the earlier run in " + options.folder.string() + " were kept",
                        "use --force to replace them with the faulty ones"));
  }
}

void add_warnings(const formats::Product& product, Reply& reply) {
  reply.diagnostics.insert(reply.diagnostics.end(), product.file.warnings.begin(), product.file.warnings.end());
  const auto add = [&](Severity severity, const std::vector<std::string>& texts) {
    for (const std::string& text : texts) reply.diagnostics.push_back(about_file(severity, product.file.path, text));
  };
  add(Severity::warning, product.synthesis.warnings);
  add(Severity::warning, product.holding.warnings);
  if (product.pulley.made()) add(Severity::note, product.pulley.layout.notes);
}

formats::DxfVersion dxf_version(const Arguments& arguments) {
  const std::string name = arguments.text("--dxf").value_or("ac1015");
  if (name == "ac1015") return formats::DxfVersion::ac1015;
  if (name == "r12") return formats::DxfVersion::r12;
  throw UsageError("--dxf must be ac1015 or r12; '" + name + "' is not");
}

pipeline::BuildOptions build_options_from(const Arguments& arguments) {
  pipeline::BuildOptions options;
  options.chord_error_mm = arguments.number("--tolerance-mm", options.chord_error_mm, 0.0005, 1.0, "mm");
  options.limits = limits_from(arguments);
  options.dxf = dxf_version(arguments);
  options.step = arguments.has("--step");
  options.force = arguments.has("--force");
  options.dry_run = arguments.has("--dry-run");
  options.folder = output_folder(arguments);
  return options;
}

/// Explains the folder of a trial.
void add_trial_note(const Arguments& arguments, Reply& reply) {
  if (arguments.settings().empty() || arguments.has("--out")) return;
  reply.diagnostics.push_back(
      make_diagnostic(Severity::note,
                      "a trial with --set has a folder of its own: files of " + arguments.positionals().front() +
                          " without --set are not replaced",
                      "mechanism.toml there has the new values; -o DIR chooses another folder"));
}

Reply run_build(const Arguments& arguments, Console& console, const RunContext& context) {
  const pipeline::BuildOptions options = build_options_from(arguments);
  const MechanismFile file = read_mechanism(arguments.positionals().front(), arguments.settings(), *context.files);
  const pipeline::BuildResult built = pipeline::build(file, options, context);
  Reply reply;
  reply.units = file.mechanism.units;
  add_warnings(built.product, reply);
  add_pins_note(file, reply);
  if (built.status == pipeline::BuildStatus::infeasible) {
    explain_infeasible(built, reply);
    return reply;
  }
  reply.text = summary(built, options, console.verbose());
  if (built.published) add_trial_note(arguments, reply);
  if (arguments.has("--json")) reply.fields = product_json(built, options);
  if (built.status == pipeline::BuildStatus::check_failed) add_failed_checks(built, options, reply);
  apply_strict(arguments, reply);
  return reply;
}

}  // namespace

Command build_command() {
  std::vector<Option> options = {
      {"-o,--out", "DIR",
       "where the files go (default: out/<name of SPEC>; with\n--set out/<name of SPEC>.<KEY=VALUE>)"},
      {"--tolerance-mm", "MM", "largest distance of facets from the curve\n(default 0.01)"},
      {"--dxf", "VERSION", "drawings as ac1015 (default) or r12", false, "ac1015 r12"},
      {"--step", "", "also write pulley.step for CAD (takes some seconds)"},
  };
  for (const Option& option : limit_options()) options.push_back(option);
  options.push_back(strict_option());
  return {"build",
          "SPEC",
          "the pulley in every format, checked",
          "Builds the pulley of the mechanism file SPEC: meshes to print, drawings to cut,\n"
          "tables and a report. Every file is read back and checked, and tendons are wound\n"
          "on the mesh to determine the joint angle of the part as built. For an infeasible\n"
          "pulley it reports where and why, and which change of which number makes it\n"
          "feasible. A trial with --set has a folder of its own, so that it never replaces\n"
          "the part of the file; mechanism.toml there is the file with the new values.",
          options,
          {{"fusee build arm.toml", "everything in out/arm; open out/arm/report.html"},
           {"fusee build arm.toml -o parts --dxf r12", "into parts, with drawings for an old laser cutter"},
           {"fusee build arm.toml --set pulley.r1_mm=15", "another r1, in out/arm.pulley.r1_mm=15"},
           {"fusee build arm.toml --set pulley.r1_mm=15 --dry-run", "test another r1 without writing files"}},
          run_build};
}

}  // namespace fusee::cli
