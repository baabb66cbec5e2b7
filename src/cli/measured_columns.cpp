#include "cli/measured_columns.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "fusee/base.h"

namespace fusee::cli {
namespace {

constexpr double k_most_counts_a_turn = 1e9, k_most_reading = 1e12;

struct RoleValue {
  std::string role, value;
};

/// The values "load=tau_out_Nm" … of one option.
std::vector<RoleValue> role_values(const Arguments& arguments, const std::string& option, const std::string& example,
                                   const std::vector<std::string>& roles) {
  std::vector<RoleValue> found;
  for (const std::string& text : arguments.texts(option)) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
      throw UsageError(
          option + " takes role=" + (option == "--column" ? "name" : "value") + "; '" + text + "' is not of that form",
          "for example: " + option + " " + example);
    }
    const std::string role = text.substr(0, equals);
    if (std::find(roles.begin(), roles.end(), role) == roles.end()) {
      const std::string nearest = nearest_word(role, roles);
      std::string list;
      for (const std::string& known : roles) {
        const bool is_rare = known.find("_turned") != std::string::npos;  // a sensor's mounting angle
        if (!is_rare) list += (list.empty() ? "" : ", ") + known;
      }
      throw UsageError(option + ": there is no role '" + role + "'",
                       nearest.empty() ? "roles: " + list : "did you mean '" + nearest + "'?");
    }
    found.push_back({role, text.substr(equals + 1)});
  }
  return found;
}

/// The number in "alpha=4096". `quantity`: "counts".
double number_in(const std::string& option, const RoleValue& given, const std::string& quantity, double most) {
  double value = 0;
  const char* const last = given.value.data() + given.value.size();
  const auto [end, error] = std::from_chars(given.value.data(), last, value);
  if (error != std::errc() || end != last || !(std::abs(value) <= most))
    throw UsageError(option + " takes a number of " + quantity + "; '" + given.value + "' is none",
                     "for example: " + option + " " + given.role + "=4096");
  return value;
}

}  // namespace

std::vector<Option> with_reading_options(std::vector<Option> options) {
  options.push_back({"--column", "ROLE=NAME",
                     "the column of a role: alpha, theta, time, load,\ntemperature …; of a bag the topic and joint, "
                     "as\n/joint_states/motor/position; repeatable",
                     true});
  options.push_back({"--unit", "ROLE=UNIT",
                     "the unit of a role's column, if its name does not\n"
                     "state it: time=ms, alpha=rad, load=kg",
                     true});
  options.push_back({"--ticks-per-turn", "ROLE=N",
                     "alpha or theta is in encoder counts, N a turn;\n"
                     "negative if they fall as the angle grows",
                     true});
  options.push_back({"--zero-ticks", "ROLE=N", "counts of that encoder at home (default 0)", true});
  options.push_back({"--home-reading", "ROLE=X",
                     "what the sensor of alpha or theta reads at\nhome, in its column's unit (default 0)", true});
  return options;
}

measurement::MeasurementOptions columns_from(const Arguments& arguments) {
  measurement::MeasurementOptions options;
  std::vector<std::string> roles;
  for (const auto& [role, column] : measurement::column_roles()) roles.push_back(role);
  for (const auto& [role, name] : role_values(arguments, "--column", "load=tau_out_Nm", roles))
    options.columns[role] = name;
  for (const auto& [role, unit] : role_values(arguments, "--unit", "time=ms", roles)) {
    if (measurement::unit_for(role, unit).empty())
      throw UsageError("--unit: " + role + " has no unit '" + unit + "'", "units: " + measurement::units_for(role));
    options.units[role] = unit;
  }
  const std::vector<std::string> angles = {"alpha", "theta"};
  for (const RoleValue& given : role_values(arguments, "--ticks-per-turn", "alpha=4096", angles)) {
    const double ticks = number_in("--ticks-per-turn", given, "counts", k_most_counts_a_turn);
    if (std::abs(ticks) < 2)
      throw UsageError("--ticks-per-turn must be 2 or more, or -2 or less if counts fall as the angle grows");
    options.ticks_per_turn[given.role] = ticks;
  }
  for (const RoleValue& given : role_values(arguments, "--zero-ticks", "theta=2048", angles)) {
    const auto unit = options.units.find(given.role);
    if (unit != options.units.end() && unit->second != "counts" && options.ticks_per_turn.count(given.role) == 0)
      throw UsageError("--zero-ticks " + given.role + " is the encoder's counts at home, and --unit " + given.role +
                           "=" + unit->second + " is another unit",
                       "give --ticks-per-turn " + given.role + "=N, or leave one of them out");
    options.zero_ticks[given.role] = number_in("--zero-ticks", given, "counts", k_most_reading);
  }
  for (const RoleValue& given : role_values(arguments, "--home-reading", "theta=153.2", angles)) {
    if (options.zero_ticks.count(given.role) > 0)
      throw UsageError("--zero-ticks " + given.role + " and --home-reading " + given.role + " are the same reading",
                       "leave one of them out");
    options.home_readings[given.role] = number_in("--home-reading", given, "its column's unit", k_most_reading);
  }
  return options;
}

}  // namespace fusee::cli
