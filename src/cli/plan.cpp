#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "base/text.h"
#include "cli/command.h"
#include "cli/table.h"
#include "fusee/base.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

constexpr double k_most_minutes = 1e5;  // ten weeks
constexpr double k_most_load = 1e6;     // N
constexpr double k_most_speed = 1e5;    // deg/s
constexpr double k_most_angle = 1e5;    // deg
/// Largest number of loads or of speeds.
constexpr std::size_t k_most_levels = 12;

// ---- options --------------------------------------------------------------------------------------------------------

/// "0,5,10": finite numbers within [least, most], each once. Throws UsageError.
std::vector<double> list_from(const Arguments& arguments, std::string_view option, double least, double most) {
  const std::optional<std::string> text = arguments.text(option);
  std::vector<double> values;
  if (!text) return values;
  const auto refuse = [&](const std::string& fault) -> void {
    throw UsageError(std::string(option) + " takes numbers from " + rounded(least) + " to " + rounded(most) +
                         ", separated by commas; " + fault,
                     "for example: " + std::string(option) + " 5,10");
  };
  std::string_view rest = *text;
  while (true) {
    const std::string_view word = rest.substr(0, rest.find(','));
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value) || value < least ||
        value > most)
      refuse("'" + std::string(word) + "' is not a number in that range");
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    if (word.size() == rest.size()) break;
    rest.remove_prefix(word.size() + 1);
  }
  if (values.size() > k_most_levels) refuse("there are more than " + std::to_string(k_most_levels));
  return values;
}

pipeline::PlanFilesOptions plan_options_from(const Arguments& arguments) {
  pipeline::PlanFilesOptions options;
  plan::PlanOptions& plan = options.plan;
  plan.noise = radians(arguments.number("--noise-deg", degrees(plan.noise), 1e-6, 45, "deg"));
  plan.minutes = arguments.number("--minutes", plan.minutes, 0, k_most_minutes, "min");
  plan.loads = list_from(arguments, "--loads", -k_most_load, k_most_load);
  for (const double speed : list_from(arguments, "--speeds", 1e-3, k_most_speed)) plan.speeds.push_back(radians(speed));
  if (const std::vector<double> range = list_from(arguments, "--range-deg", -k_most_angle, k_most_angle);
      !range.empty()) {
    if (range.size() != 2 || range[0] >= range[1])
      throw UsageError("--range-deg takes two motor angles, the smaller first", "for example: --range-deg -90,90");
    plan.range = {radians(range[0]), radians(range[1])};
  }
  plan.seed = static_cast<std::uint64_t>(arguments.whole_number("--seed", 1, 0, k_largest_seed, "(a whole number)"));
  options.folder = output_folder(arguments, "_plan");
  options.force = arguments.has("--force");
  options.dry_run = arguments.has("--dry-run");
  return options;
}

// ---- reply ----------------------------------------------------------------------------------------------------------

std::string steps_text(const plan::Plan& plan) {
  std::string text;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const plan::PlanStep& step = plan.steps[i];
    const std::string file = step.run ? formats::run_file_name(plan, i) + ", " : "";
    text += wrapped(file + step.words + " (" + fixed(step.minutes, 1) + " min)", "  " + std::to_string(i + 1) + ". ",
                    "     ");
  }
  return text;
}

std::string causes_text(const plan::Plan& plan) {
  std::vector<std::vector<std::string>> rows;
  for (const plan::PlannedCause& cause : plan.causes) {
    rows.push_back({"  " + cause.name, rounded(degrees(cause.usual), 2), rounded(degrees(cause.smallest), 2),
                    cause.smallest_alone ? rounded(degrees(*cause.smallest_alone), 2) : "–"});
  }
  return table({{"deg rms at the joint"},
                {"usual", Align::right},
                {"detected from", Align::right},
                {"identified from", Align::right}},
               rows);
}

/// A list under its title; "" without lines.
std::string listed(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = "\n" + title + "\n";
  for (const std::string& line : lines) text += wrapped(line, "  - ", "    ");
  return text;
}

std::vector<std::string> group_words(const plan::Plan& plan) {
  std::vector<std::string> lines;
  for (const std::vector<std::string>& group : plan.groups) {
    std::string line;
    for (const std::string& name : group) line += (line.empty() ? "" : ", ") + name;
    lines.push_back(line);
  }
  return lines;
}

std::string summary(const formats::PlanProduct& product) {
  const plan::Plan& plan = product.plan;
  std::size_t alone = 0;
  for (const plan::PlannedCause& cause : plan.causes) alone += cause.smallest_alone.has_value();
  std::string text = product.file.mechanism.name + ": " + fixed(plan.minutes, 1) + " of " + rounded(product.minutes) +
                     " minutes, " + std::to_string(alone) + " of " + std::to_string(plan.causes.size()) +
                     " causes can be identified individually\n" + steps_text(plan) + "\n" + causes_text(plan);
  text += listed("Not resolved", group_words(plan));
  text += listed("More minutes", formats::minute_words(plan.beyond));
  return text + listed("False-positive rate", formats::false_positive_words(plan));
}

void refuse_short_time(const pipeline::PlanResult& result, const std::string& path, Reply& reply) {
  const std::vector<plan::PlanStep>& first = result.product.plan.beyond;
  reply.exit = Exit::bad_input;
  const std::string given = rounded(result.product.minutes) + (result.product.minutes == 1 ? " minute" : " minutes");
  if (first.empty()) {
    reply.diagnostics.push_back(
        about_file(Severity::error, path, "no run is possible: the joint has no equilibrium in any of them"));
    return;
  }
  Diagnostic error = make_diagnostic(
      Severity::error,
      "nothing can be measured in " + given + ": the first run takes " + rounded(first.front().minutes, 3) + " minutes",
      "--minutes " + rounded(std::ceil(first.front().minutes)) + " or more, or a higher --speeds");
  reply.diagnostics.push_back(error);
  for (const std::string& words : formats::minute_words(first))
    reply.diagnostics.push_back(make_diagnostic(Severity::note, words));
}

Reply run_plan(const Arguments& arguments, Console&, const RunContext& context) {
  const std::filesystem::path spec = arguments.positionals().front();
  const pipeline::PlanFilesOptions options = plan_options_from(arguments);
  const MechanismFile file = read_mechanism(spec, arguments.settings(), *context.files);
  const pipeline::PlanResult result = pipeline::plan(file, options, context);
  Reply reply;
  reply.diagnostics = result.product.file.warnings;
  reply.units = file.mechanism.units;
  if (result.without_law) {
    explain_without_law(file.path, *result.without_law, reply);
    return reply;
  }
  reply.fields = parse_json(formats::plan_json(result.product));
  reply.fields["folder"] = options.folder.string();
  reply.fields["published"] = result.published;
  if (result.product.plan.steps.empty()) {
    refuse_short_time(result, file.path, reply);
    return reply;
  }
  if (const std::string slack = result.product.plan.slack_words(); !slack.empty())
    reply.diagnostics.push_back(about_file(Severity::note, file.path, slack));
  reply.text = summary(result.product) + "\n" + (result.published ? "In " : "Would be written (--dry-run): ") +
               options.folder.string() + ": plan.html for the bench, and empty run files\n";
  return reply;
}

}  // namespace

Command plan_command() {
  return {"plan",
          "SPEC",
          "which runs to measure, and what they can show",
          "Finds the shortest set of runs that distinguishes the causes which matter for\n"
          "the joint of SPEC. Every candidate run is simulated with every cause of the\n"
          "catalogue at its usual size, and runs are chosen by their gain per minute.\n"
          "Reports the smallest detectable size of each cause, causes that are not\n"
          "resolved, the expected false-positive rate, and the gain of more minutes.\n"
          "Writes plan.html (for the bench), plan.json and empty run files for\n"
          "'fusee calibrate', which 'fusee simulate' can fill.",
          {{"-o,--out", "DIR", "where the files go (default: out/<name of SPEC>_plan)"},
           {"--noise-deg", "DEG", "standard deviation of the joint's sensor\n(default 0.02)"},
           {"--minutes", "MIN", "time at the bench (default 15)"},
           {"--loads", "N,N,...", "available tip forces (default: chosen)"},
           {"--speeds", "DEG/S,...", "motor speeds (default: a cycle in 30 s and in 6 s)"},
           {"--range-deg", "FROM,TO", "motor range (default: the joint's range)"},
           {"--seed", "N", "random seed of the simulated joints (default 1)"}},
          {{"fusee plan arm.toml", "files in out/arm_plan; open its plan.html"},
           {"fusee plan arm.toml --minutes 5 --loads 0,5", "five minutes, and one weight"},
           {"fusee plan arm.toml --set prior.pulley_scale=[1,0.001] --dry-run", "a caliper reading is known"}},
          run_plan};
}

}  // namespace fusee::cli
