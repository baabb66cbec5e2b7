#include <algorithm>
#include <filesystem>

#include "base/output_list.h"
#include "base/text.h"
#include "cli/as_built.h"
#include "cli/command.h"
#include "cli/pins.h"
#include "cli/table.h"
#include "export/report/tendon_lengths.h"
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
  Range alpha, theta, r1, r2;  ///< deg, mm
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

std::string size_text(std::size_t bytes) {
  return bytes < 10000 ? std::to_string(bytes) + " B" : std::to_string((bytes + 500) / 1000) + " kB";
}

std::string files_text(const pipeline::BuildResult& built, const pipeline::BuildOptions& options) {
  if (options.dry_run) return titled("files", "none written (--dry-run)");
  if (!built.published) return titled("files", "none written: " + options.folder.string() + " keeps its earlier run");
  std::string text = titled("files", "in " + options.folder.string());
  for (const OutputFile& file : built.outputs) {
    std::string name = file.name;
    name.resize(18, ' ');
    const std::string size = size_text(file.bytes.size());
    text += std::string(14, ' ') + name + std::string(8 - std::min<std::size_t>(8, size.size()), ' ') + size + "\n";
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
  return text.empty() ? text : titled("tendons", text + ", with knots and two 50 mm tails");
}

std::string knots_text(const solid::Holding& holding) {
  std::string text;
  for (const solid::KnotHold& knot : holding.knots) {
    const std::optional<double> share = holding.share(knot);
    const std::string of_what = text.empty() ? " % of its strength)" : " %)";
    text += (text.empty() ? "" : ", ") + std::string(knot.side == transmission::Side::left ? "1" : "2") + " up to " +
            rounded(knot.at_knot, 3) + " N" + (share ? " (" + rounded(100.0 * *share, 2) + of_what : "");
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
  text += tendons_text(product) + knots_text(product.holding);
  text += titled("as built", as_built_text(product.as_built));
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
  json["as_built"] = to_json(product.as_built);
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
  add_advice(built.advice.alone, reply, built.advice.is_exhausted);
  add_advice_together(built.advice.together, reply);
  add_layout_advice(built.advice.layout, reply);
  reply.exit = Exit::infeasible;
  reply.fields["conditions"] = to_json(conditions);
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
    reply.diagnostics.push_back(note(Severity::note,
                                     "the files of the earlier run in " + options.folder.string() + " were kept",
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

/// The stems of "..toml" and "...toml" are not folder names but "." and "..".
std::filesystem::path default_folder(const std::filesystem::path& spec) {
  const std::filesystem::path stem = spec.stem();
  return "out" / (stem == "." || stem == ".." ? spec.filename() : stem);
}

pipeline::BuildOptions build_options_from(const Arguments& arguments) {
  pipeline::BuildOptions options;
  options.chord_error_mm = arguments.number("--tolerance-mm", options.chord_error_mm, 0.0005, 1.0, "mm");
  options.limits = limits_from(arguments);
  options.dxf = dxf_version(arguments);
  options.step = arguments.has("--step");
  options.force = arguments.has("--force");
  options.dry_run = arguments.has("--dry-run");
  options.folder = arguments.text("--out").value_or(default_folder(arguments.positionals().front()).string());
  return options;
}

Reply run_build(const Arguments& arguments, Console& console, const RunContext& context) {
  const pipeline::BuildOptions options = build_options_from(arguments);
  const MechanismFile file = read_mechanism(arguments.positionals().front(), arguments.settings(), *context.files);
  const pipeline::BuildResult built = pipeline::build(file, options, context);
  Reply reply;
  add_warnings(built.product, reply);
  add_pins_note(file, reply);
  if (built.status == pipeline::BuildStatus::infeasible) {
    explain_infeasible(built, reply);
    return reply;
  }
  reply.text = summary(built, options, console.verbose());
  if (arguments.has("--json")) reply.fields = product_json(built, options);
  if (built.status == pipeline::BuildStatus::check_failed) add_failed_checks(built, options, reply);
  return reply;
}

}  // namespace

Command build_command() {
  std::vector<Option> options = {
      {"-o,--out", "DIR", "where the files go (default: out/<name of SPEC>)"},
      {"--tolerance-mm", "MM", "largest distance of facets from the curve\n(default 0.01)"},
      {"--dxf", "VERSION", "drawings as ac1015 (default) or r12", false, "ac1015 r12"},
      {"--step", "", "also write pulley.step for CAD (takes some seconds)"},
  };
  for (const Option& option : limit_options()) options.push_back(option);
  return {"build",
          "SPEC",
          "the pulley in every format, checked",
          "Builds the pulley of the mechanism file SPEC: meshes to print, drawings to cut,\n"
          "tables and a report. Every file is read back and checked, and tendons are wound\n"
          "on the mesh to determine the joint angle of the part as built. For an infeasible\n"
          "pulley it reports where and why, and which change of which number makes it\n"
          "feasible.",
          options,
          {{"fusee build arm.toml", "everything in out/arm; open out/arm/report.html"},
           {"fusee build arm.toml -o parts --dxf r12", "into parts, with drawings for an old laser cutter"},
           {"fusee build arm.toml --set pulley.r1_mm=15 --dry-run", "test another r1 without writing files"}},
          run_build};
}

}  // namespace fusee::cli
