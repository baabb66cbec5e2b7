// plan.json, the empty run files and manifest.json of a plan.

#include <cmath>
#include <filesystem>

#include "base/output_list.h"
#include "base/text.h"
#include "export/report/csv_cells.h"
#include "export/report/input_json.h"
#include "export/tool.h"
#include "fusee/base.h"
#include "fusee/export.h"
#include "fusee/measurement.h"
#include "mechanism/effect.h"
#include "mechanism/lengths.h"
#include "transmission/load.h"

namespace fusee::formats {
namespace {

/// Rows of a run file for each stroke: they show its shape, and a person can still set them one by one.
constexpr int k_rows_a_stroke = 120;

/// A value whose uncertainty is some tens of percent, to four digits.
Json four_digits_json(double value) { return std::isfinite(value) ? Json(number_of(rounded(value, 4))) : Json(); }

std::string_view word(plan::BenchChange change) {
  switch (change) {
    case plan::BenchChange::motor_sensor_turned:
      return "motor_sensor_turned";
    case plan::BenchChange::joint_sensor_turned:
      return "joint_sensor_turned";
    case plan::BenchChange::none:
      break;
  }
  return "none";
}

void add_run(const plan::PlannedRun& run, const std::string& load_unit, Json& json) {
  json["load" + std::string(load_unit == "N" ? "_N" : "")] = result_json(run.load);
  json["speed_deg_per_s"] = angle_json(run.speed);
  json["cycles"] = run.cycles;
  json["dwell_s"] = result_json(run.dwell);
  json["from_deg"] = angle_json(run.from);
  json["to_deg"] = angle_json(run.to);
  json["bench"] = word(run.change);
}

Json step_json(const plan::Plan& plan, const plan::PlanStep& step, const std::string& file) {
  Json json = {{"kind", step.run ? "run" : "reading"}};
  if (step.run) {
    json["file"] = file.empty() ? Json() : Json(file);
    add_run(*step.run, plan.load_unit, json);
  } else {
    json["key"] = step.reading->key.name;
    json["uncertainty"] = result_json(step.reading->by_hand.uncertainty);
  }
  json["words"] = step.words;
  json["minutes"] = result_json(step.minutes);
  json["setup_minutes"] = result_json(step.setup_minutes);
  json["by_minute"] = result_json(step.end_minute);
  json["sees"] = step.detects;
  json["tells"] = step.resolves;
  return json;
}

Json steps_json(const plan::Plan& plan, const std::vector<plan::PlanStep>& steps, bool with_files) {
  Json list = Json::array();
  for (std::size_t i = 0; i < steps.size(); ++i)
    list.push_back(step_json(plan, steps[i], with_files ? run_file_name(plan, i) : ""));
  return list;
}

Json cause_json(const plan::PlannedCause& cause) {
  return {{"name", cause.name},
          {"usual_deg", four_digits_json(degrees(cause.usual))},
          {"smallest_deg", four_digits_json(degrees(cause.smallest))},
          {"smallest_alone_deg", cause.smallest_alone ? four_digits_json(degrees(*cause.smallest_alone)) : Json()},
          {"smallest", {{"key", "identified." + cause.key}, {"value", four_digits_json(cause.smallest_key)}}},
          {"confounded_with", cause.rivals}};
}

Json false_positives_json(const plan::FalsePositives& rates) {
  return {{"worlds", rates.samples},
          {"falsely_blamed", rates.wrong},
          {"named_alone", rates.alone},
          {"named_in_group", rates.group}};
}

std::string comment_lines(const PlanProduct& product, std::size_t step) {
  const plan::PlannedRun& run = *product.plan.steps[step].run;
  std::string text = "# " + product.file.mechanism.name + ", " + run_file_name(product.plan, step) + ": " +
                     product.plan.steps[step].words + "\n";
  if (const std::string hanging = hanging_words(product, run); !hanging.empty()) text += "# " + hanging + "\n";
  text += "# motor from " + fixed(degrees(run.from), 2) + " to " + fixed(degrees(run.to), 2) + " deg and back, " +
          std::to_string(run.cycles) + " times, at " + rounded(degrees(run.speed), 4) + " deg/s" +
          (run.dwell > 0 ? ", held for " + rounded(run.dwell, 4) + " s at both ends" : std::string()) + "\n";
  return text + "# write what the joint's sensor shows into theta_deg, or put your own log in this file's place\n";
}

}  // namespace

std::string run_file_name(const plan::Plan& plan, std::size_t step) {
  if (!plan.steps[step].run) return "";
  int run = plan.first_run - 1;
  for (std::size_t i = 0; i <= step; ++i) run += plan.steps[i].run ? 1 : 0;
  return "run_" + std::to_string(run) + ".csv";
}

std::string hanging_words(const PlanProduct& product, const plan::PlannedRun& run) {
  if (run.load == 0) return "";
  const Mechanism& declared = product.file.mechanism;
  if (declared.transmission) return "load " + rounded(run.load, 4) + " in the unit of your log";
  const double mass = std::abs(run.load) / transmission::k_gravity;
  const std::string words = "tip force " + rounded(run.load, 4) + " N, " + (run.load > 0 ? "against" : "along") +
                            " +theta: hang " + rounded(mass, 3) + " kg on a cord over a disc of radius " +
                            rounded(declared.joint.R, 4) + " mm on the joint's axis (torque " +
                            rounded(std::abs(run.load) * declared.joint.R, 4) + " N·mm at every angle)";
  return lengths_in(product.file.mechanism.units, words);
}

std::string run_csv(const PlanProduct& product, std::size_t step) {
  const joint::BenchRun driven = fusee::plan::driven(*product.plan.steps[step].run, k_rows_a_stroke);
  const joint::Mounting& mounting = driven.mounting;
  std::string table = comment_lines(product, step) + "time_s,alpha_deg,load_N,theta_deg";
  if (mounting.motor_sensor_turned != 0) table += "," + std::string(measurement::k_motor_sensor_turned) + "_deg";
  if (mounting.joint_sensor_turned != 0) table += "," + std::string(measurement::k_joint_sensor_turned) + "_deg";
  table += "\n";
  for (const joint::BenchRow& row : driven.rows) {
    table += trimmed_fixed(row.time, 3) + "," + trimmed_fixed(degrees(row.alpha), 4) + "," + shortest(row.load) + ",";
    if (mounting.motor_sensor_turned != 0) table += "," + trimmed_fixed(degrees(mounting.motor_sensor_turned), 3);
    if (mounting.joint_sensor_turned != 0) table += "," + trimmed_fixed(degrees(mounting.joint_sensor_turned), 3);
    table += "\n";
  }
  return table;
}

std::string plan_json(const PlanProduct& product) {
  const plan::Plan& plan = product.plan;
  Json json = {{"schema", 1}, {"name", product.file.mechanism.name}};
  json["noise_deg"] = angle_json(product.noise);
  json["minutes"] = result_json(product.minutes);
  json["minutes_used"] = result_json(plan.minutes);
  json["motor_range_deg"] = {angle_json(plan.from), angle_json(plan.to)};
  if (plan.taut_load) json["taut_up_to_load_N"] = result_json(*plan.taut_load);
  json["steps"] = steps_json(plan, plan.steps, true);
  json["more_minutes"] = steps_json(plan, plan.beyond, false);
  json["causes"] = Json::array();
  for (const plan::PlannedCause& cause : plan.causes) json["causes"].push_back(cause_json(cause));
  json["groups"] = plan.groups;
  json["left_out"] = Json::array();
  for (const auto& [name, why] : plan.left_out) json["left_out"].push_back({{"name", name}, {"why", why}});
  json["false_blame"] = {{"nothing_wrong", false_positives_json(plan.nothing)},
                         {"one_cause", false_positives_json(plan.one)},
                         {"cause_not_in_catalogue", false_positives_json(plan.unmodelled)}};
  return json_text(json, 1);
}

std::string plan_manifest_json(const PlanProduct& product, const std::vector<OutputFile>& outputs) {
  Json json = {{"schema", 1}, {"tool", std::string(k_tool)}};
  json["input"] = input_json(product.file);
  json["outputs"] = output_list(outputs);
  return json_text(json, 1);
}

}  // namespace fusee::formats
