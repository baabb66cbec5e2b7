#include "export/report/under_load.h"

#include "base/text.h"
#include "export/report/html.h"
#include "export/report/svg.h"
#include "export/report/tables.h"

namespace fusee::formats {
namespace {

Json ranges_json(const std::vector<analysis::AlphaRange>& ranges) {
  Json list = Json::array();
  for (const analysis::AlphaRange& range : ranges) list.push_back({angle_json(range.from), angle_json(range.to)});
  return list;
}

Json optional_json(const std::optional<double>& value) { return value ? result_json(*value) : Json(); }

/// Unknown limits are 0.
Json limit_json(double value) { return value > 0 ? result_json(value) : Json(); }

Json margin_json(double limit, double needed) { return limit > 0 && needed > 0 ? result_json(limit / needed) : Json(); }

Json change_json(const profile::Change& change) {
  return {{"key", change.key}, {"from", change.from}, {"to", change.to}, {"unit", change.unit}, {"text", change.text}};
}

bool is_ok(const analysis::MotorCheck& motor, std::string_view name) {
  for (const profile::Condition& condition : motor.conditions) {
    if (condition.name == name) return condition.ok;
  }
  return true;
}

/// `tendon`: 1 or 2.
std::string slack_sentence(const analysis::UnderLoad& load, int tendon) {
  const std::vector<analysis::AlphaRange>& ranges = tendon == 1 ? load.slack1 : load.slack2;
  if (ranges.empty()) return "";
  const std::string remedy = pretension_words(load, ranges);
  return " Tendon " + std::to_string(tendon) + " is slack " + (load.is_whole_range(ranges) ? "" : "at ") +
         slack_words(load, ranges) + (remedy.empty() ? "." : ": " + remedy + ".");
}

}  // namespace

std::string load_words(const Mechanism& mechanism) {
  const Load& load = mechanism.load;
  const bool has_spring = mechanism.spring != Spring{};
  if (load == Load{}) return has_spring ? "under [spring]" : "without load";
  Load tip_only, torque_only;
  tip_only.tip_force = load.tip_force;
  torque_only.torque = load.torque;
  if (!has_spring && load == tip_only) return "under " + rounded(load.tip_force, 3) + " N";
  if (!has_spring && load == torque_only) return "under " + rounded(load.torque, 3) + " N·mm";
  return has_spring ? "under [load] and [spring]" : "under [load]";
}

Json under_load_json(const analysis::UnderLoad& load) {
  return {{"max_theta_error_deg", angle_json(load.theta_error.value)},
          {"max_theta_error_at_alpha_deg", angle_json(load.theta_error.alpha)},
          {"slack1", ranges_json(load.slack1)},
          {"slack2", ranges_json(load.slack2)},
          {"taut_pretension_N", optional_json(load.taut_pretension)},
          {"largest_tension_N", result_json(load.largest_tension.tension)},
          {"safety_factor", optional_json(load.safety_factor())},
          {"strength_N", load.strength ? result_json(load.strength->tension) : Json()},
          {"strength_source", load.strength ? Json(load.strength->source) : Json()},
          {"no_equilibrium_at_alpha_deg", load.lost_at ? angle_json(*load.lost_at) : Json()}};
}

Json motor_json(const analysis::MotorCheck& motor) {
  Json json;
  json["model"] = motor.model.empty() ? Json() : Json(motor.model);
  json["enforce"] = motor.enforced;
  json["ok"] = motor.ok();
  json["travel"] = {{"needed_deg", angle_json(motor.travel)},
                    {"limit_deg", limit_json(degrees(motor.travel_limit))},
                    {"margin", margin_json(motor.travel_limit, motor.travel)},
                    {"ok", is_ok(motor, "motor_travel")}};
  json["torque"] = {{"needed_Nmm", result_json(motor.torque.value)},
                    {"alpha_deg", angle_json(motor.torque.alpha)},
                    {"limit_Nmm", limit_json(motor.torque_limit)},
                    {"margin", margin_json(motor.torque_limit, motor.torque.value)},
                    {"ok", is_ok(motor, "motor_torque")}};
  json["speed"] = {{"motor_deg_per_s", limit_json(degrees(motor.speed_limit))},
                   {"largest_ratio", result_json(motor.ratio)},
                   {"joint_without_load_deg_per_s", limit_json(degrees(motor.joint_speed_free))},
                   {"joint_deg_per_s", motor.speed_limit > 0 ? angle_json(motor.joint_speed) : Json()},
                   {"needed_joint_deg_per_s", limit_json(degrees(motor.joint_speed_needed))},
                   {"margin", motor.speed_limit > 0 && motor.joint_speed_needed > 0
                                  ? result_json(motor.joint_speed / motor.joint_speed_needed)
                                  : Json()},
                   {"ok", is_ok(motor, "motor_speed")}};
  json["sufficient_models"] = motor.sufficient_models;
  json["fitting_models"] = motor.fitting_models;
  json["strongest_fitting_model"] = motor.strongest_model.empty() ? Json() : Json(motor.strongest_model);
  json["fits_bore"] = motor.misfit.empty();
  json["advice"] = Json::array();
  for (const profile::Change& change : motor.advice.alone) json["advice"].push_back(change_json(change));
  for (const profile::Change& change : motor.advice.together) json["advice_together"].push_back(change_json(change));
  return json;
}

std::string slack_words(const analysis::UnderLoad& load, const std::vector<analysis::AlphaRange>& ranges) {
  if (load.is_whole_range(ranges)) return "over the whole range";
  std::string words;
  for (const analysis::AlphaRange& range : ranges)
    words += (words.empty() ? "α = " : ", ") + readable(degrees(range.from), 1) + "°" +
             (range.to == range.from ? "" : " … " + readable(degrees(range.to), 1) + "°");
  return words.empty() ? "nowhere" : words;
}

std::string pretension_words(const analysis::UnderLoad& load, const std::vector<analysis::AlphaRange>& ranges) {
  if (ranges.empty() || !load.taut_pretension) return "";
  return "tendon.pretension_N ≥ " + rounded(*load.taut_pretension, 3) + " keeps it taut";
}

std::string under_load_sentences(const analysis::UnderLoad& load, const Mechanism& mechanism) {
  if (load.rows.empty()) return "";
  std::string words = " " + load_words(mechanism);
  words[1] = words[1] == 'u' ? 'U' : 'W';  // load_words() begins with "under" or "without"
  if (load.lost_at)
    return words + ", there is no equilibrium at α = " + readable(degrees(*load.lost_at), 1) +
           "°: the load pulls the joint past its dead centre.";
  words += ", θ is off by up to " + with_unit(degrees(load.theta_error.value), "deg") +
           " (at α = " + readable(degrees(load.theta_error.alpha), 1) + "°).";
  words += slack_sentence(load, 1) + slack_sentence(load, 2);
  if (const auto least = load.least_tension())
    words += " Both tendons stay taut over the whole range: the least tension is " + with_unit(least->value, "N") +
             " (at α = " + readable(degrees(least->alpha), 1) + "°).";
  if (const auto factor = load.safety_factor())
    words += " The tendons’ safety factor against breaking is " + readable_rounded(*factor, 3) + ".";
  return words;
}

void add_motor(KeyNumbers& numbers, const analysis::UnderLoad& load) {
  if (!load.motor) return;
  const analysis::MotorCheck& motor = *load.motor;
  const auto of_limit = [](double limit, const std::string& unit) {
    return limit > 0 ? " of " + with_unit(limit, unit, 4) : "";
  };
  const auto margin = [](double limit, double needed) {
    return limit > 0 && needed > 0 ? "margin " + readable_rounded(limit / needed, 3) : "";
  };
  numbers.add("Motor", motor.model.empty() ? "its own numbers" : motor.model, motor.enforced ? "enforced" : "");
  numbers.add("Travel required",
              with_unit(degrees(motor.travel), "deg", 4) + of_limit(degrees(motor.travel_limit), "deg"),
              margin(motor.travel_limit, motor.travel));
  numbers.add("Torque required", with_unit(motor.torque.value, "N·mm", 4) + of_limit(motor.torque_limit, "N·mm"),
              margin(motor.torque_limit, motor.torque.value));
  if (motor.speed_limit > 0)
    numbers.add("Joint speed under load", with_unit(degrees(motor.joint_speed), "deg/s"),
                motor.joint_speed_needed > 0 ? with_unit(degrees(motor.joint_speed_needed), "deg/s") + " required, " +
                                                   margin(motor.joint_speed, motor.joint_speed_needed)
                                             : with_unit(degrees(motor.joint_speed_free), "deg/s") + " without load");
}

}  // namespace fusee::formats
