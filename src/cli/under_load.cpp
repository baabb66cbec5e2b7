#include "cli/under_load.h"

#include <algorithm>

#include "base/text.h"
#include "cli/table.h"
#include "mechanism/catalogue.h"

namespace fusee::cli {
namespace {

std::string range_text(const analysis::AlphaRange& range) {
  if (range.from == range.to) return "at " + alpha_text(range.from);
  return "alpha = " + fixed(degrees(range.from), 1) + " to " + fixed(degrees(range.to), 1) + " deg";
}

/// "250.6 of 180 deg (margin 0.718)"; "250.6 deg" without a limit, which is 0.
std::string compared_with_limit(double needed, double limit, const std::string& unit) {
  const std::string text = rounded(needed, 4) + (limit > 0 ? " of " + rounded(limit, 4) : "") + " " + unit;
  return limit > 0 && needed > 0 ? text + " (margin " + rounded(limit / needed, 3) + ")" : text;
}

std::string speed_text(const analysis::MotorCheck& motor) {
  std::string text = "joint turns at " + rounded(degrees(motor.joint_speed), 3) + " deg/s under the load";
  if (motor.joint_speed_needed > 0)
    text += ", " + rounded(degrees(motor.joint_speed_needed), 3) + " required (margin " +
            rounded(motor.joint_speed / motor.joint_speed_needed, 3) + ")";
  return text + ", " + rounded(degrees(motor.joint_speed_free), 3) + " without";
}

}  // namespace

std::string alpha_text(double alpha) { return "alpha = " + fixed(degrees(alpha), 1) + " deg"; }

std::string slack_text(const analysis::UnderLoad& load, const std::vector<analysis::AlphaRange>& ranges) {
  if (load.is_whole_range(ranges)) return "over the whole range";
  std::string text;
  for (const analysis::AlphaRange& range : ranges) text += (text.empty() ? "" : ", ") + range_text(range);
  return text;
}

std::string pretension_text(const analysis::UnderLoad& load) {
  if (!load.taut_pretension) return "";
  return "tendon.pretension_N >= " + rounded(*load.taut_pretension, 3) + " keeps it taut";
}

std::string safety_text(const analysis::UnderLoad& load) {
  const auto factor = load.safety_factor();
  if (!factor) return "";
  return rounded(*factor, 3) + " against breaking (" + load.strength->source + ")";
}

std::string under_load_lines(const analysis::UnderLoad& load, const std::string& load_words, std::size_t column) {
  const std::size_t space = load_words.find(' ');
  const bool is_loaded = load_words.starts_with("under ");
  const std::string title = is_loaded ? "under load" : "no load";
  const std::string load_prefix = is_loaded ? load_words.substr(space + 1) + ": " : "";
  if (load.lost_at) return titled(title, load_prefix + "no equilibrium at " + alpha_text(*load.lost_at), column);
  std::string text = titled(title,
                            load_prefix + "theta up to " + rounded(degrees(load.theta_error.value), 3) + " deg off, " +
                                alpha_text(load.theta_error.alpha),
                            column);
  for (const bool first : {true, false}) {
    const std::vector<analysis::AlphaRange>& ranges = first ? load.slack1 : load.slack2;
    if (ranges.empty()) continue;
    const std::string remedy = pretension_text(load);
    text += titled("",
                   std::string("tendon ") + (first ? "1" : "2") + " slack " + slack_text(load, ranges) +
                       (remedy.empty() ? "" : ": " + remedy),
                   column);
  }
  if (const auto least = load.least_tension())
    text += titled(
        "", "both tendons taut: " + rounded(least->value, 3) + " N or more, least at " + alpha_text(least->alpha),
        column);
  if (const std::string safety = safety_text(load); !safety.empty())
    text += titled("", "safety factor " + safety, column);
  return text;
}

std::string motor_lines(const analysis::UnderLoad& load, std::size_t column) {
  if (!load.motor) return "";
  const analysis::MotorCheck& motor = *load.motor;
  const std::string name = motor.model.empty() ? "" : motor.model + ": ";
  std::string text =
      titled("motor", name + "travel " + compared_with_limit(degrees(motor.travel), degrees(motor.travel_limit), "deg"),
             column);
  text += titled("",
                 "torque " + compared_with_limit(motor.torque.value, motor.torque_limit, "Nmm") + ", " +
                     alpha_text(motor.torque.alpha),
                 column);
  if (motor.speed_limit > 0) text += titled("", speed_text(motor), column);
  if (const std::string strongest = motor.strongest_text(); !strongest.empty()) text += titled("", strongest, column);
  for (const std::string& models : motor.models_texts()) text += titled("", models, column);
  return text + titled("",
                       "margin of suitable motors: " + rounded(MotorModel{}.advised_margin()) +
                           " or more, 1 or more if they hold their torque",
                       column);
}

}  // namespace fusee::cli
