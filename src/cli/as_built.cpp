#include "cli/as_built.h"

#include "base/json.h"
#include "base/text.h"
#include "cli/table.h"

namespace fusee::cli {
namespace {

/// Counts and ratios have the unit "1", which is not printed.
std::string with_unit(double value, const std::string& unit) {
  return rounded(value) + (unit == "1" ? "" : " " + unit);
}

}  // namespace

const std::vector<Option>& limit_options() {
  static const std::vector<Option> options = {
      {"--max-theta-error-deg", "DEG", "largest error of the joint angle (default 0.05)"},
      {"--max-slack-mm", "MM", "largest excess length of a tendon (default 0.05)"},
  };
  return options;
}

pipeline::AsBuiltLimits limits_from(const Arguments& arguments) {
  pipeline::AsBuiltLimits limits;
  limits.theta_error_deg = arguments.number("--max-theta-error-deg", limits.theta_error_deg, 0.0, 180.0, "deg");
  limits.excess = arguments.number("--max-slack-mm", limits.excess, 0.0, 1000.0, "mm");
  return limits;
}

std::string as_built_text(const profile::RewindResult& as_built) {
  return "theta within " + rounded(degrees(as_built.max_theta_error), 2) + " deg, excess length within " +
         rounded(as_built.max_excess, 2) + " mm";
}

Json to_json(const profile::RewindResult& as_built) {
  return {{"max_theta_error_deg", angle_json(as_built.max_theta_error)},
          {"max_theta_error_at_alpha_deg", angle_json(as_built.max_theta_error_at)},
          {"max_slack_mm", result_json(as_built.max_excess)},
          {"max_slack_at_alpha_deg", angle_json(as_built.max_excess_at)}};
}

std::string checks_table(const std::vector<Check>& checks) {
  std::vector<std::vector<std::string>> rows;
  for (const Check& check : checks) {
    rows.push_back({check.ok ? "ok" : "FAILED", check.name, rounded(check.value), rounded(check.limit),
                    check.unit == "1" ? "" : check.unit, check.where});
  }
  return table({{""}, {"check"}, {"value", Align::right}, {"limit", Align::right}, {"unit"}, {"where"}}, rows);
}

void add_failures(const std::vector<Check>& checks, Reply& reply) {
  for (const Check& check : checks) {
    if (check.ok) continue;
    reply.diagnostics.push_back(make_diagnostic(
        Severity::error, "check '" + check.name + "' failed: " + with_unit(check.value, check.unit) + ", limit " +
                             with_unit(check.limit, check.unit) + (check.where.empty() ? "" : "; " + check.where)));
  }
}

}  // namespace fusee::cli
