// joint_table.json and manifest.json.

#include <cmath>
#include <filesystem>

#include "base/output_list.h"
#include "base/text.h"
#include "export/model/words.h"
#include "export/report/input_json.h"
#include "export/tool.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

using namespace model_words;

/// A float as a short number that reads back as the same float.
double short_number(float value) { return number_of(c_float(value)); }

Json list_json(const std::vector<float>& values) {
  Json list = Json::array();
  for (const float value : values) list.push_back(short_number(value));
  return list;
}

Json coefficients_json(const model::Polynomial& p) {
  Json list = Json::array();
  for (const double c : p.c) list.push_back(number_of(coefficient(c)));
  return list;
}

/// Rounded up, as a bound.
double bound_deg(double angle) { return number_of(at_most_deg(angle)); }

std::string_view word(model::CurveSource source) {
  switch (source) {
    case model::CurveSource::identified:
      return "identified";
    case model::CurveSource::compensation:
      return "compensation";
    case model::CurveSource::law:
      break;
  }
  return "declared";
}

/// The motor's direction of motion for which a table holds.
std::string direction_word(const model::JointTable& table, std::size_t index) {
  if (table.ways.size() == 1) return "both";
  return index == 0 ? "up" : "down";
}

}  // namespace

std::string joint_table_json(const ModelProduct& product) {
  const model::JointTable& table = product.table;
  Json json = {{"schema", 1},
               {"tool", std::string(k_tool)},
               {"input", input_json(product.file)},
               {"name", product.mechanism.name}};
  json["source"] = word(product.curves.sensed.source);
  json["what"] = Json::array();
  for (const std::string& line : curve_words(product.curves.sensed, product, true)) json["what"].push_back(line);
  json["motor_unit"] = {
      {"name", table.unit.ticks ? "count" : "deg"}, {"per_turn", table.unit.per_turn}, {"zero", table.unit.zero}};
  json["pieces"] = table.pieces;
  json["theta_deg"] = {short_number(table.theta_first_deg), short_number(table.theta_last_deg)};
  json["ways"] = Json::array();
  for (std::size_t i = 0; i < table.ways.size(); ++i) {
    const model::OneWayTable& way = table.ways[i];
    json["ways"].push_back({{"moving", direction_word(table, i)},
                            {"motor", {short_number(way.first), short_number(way.last)}},
                            {"theta_deg_of_motor", list_json(way.theta_deg)},
                            {"motor_of_theta", list_json(way.motor)}});
  }
  json["slope_of_motor"] = list_json(table.slope);
  json["holding_torque_Nmm_of_motor"] = table.holding.empty() ? Json(nullptr) : list_json(table.holding);
  json["errors"] = {{"theta_deg", bound_deg(table.errors.theta)},
                    {"returned_theta_deg", bound_deg(table.errors.returned)},
                    {"alpha_deg", bound_deg(table.errors.motor)}};
  json["polynomial"] = {{"of", product.equality.of_alpha ? "alpha" : "theta"},
                        {"coefficients_rad", coefficients_json(product.equality.p)},
                        {"theta_error_deg", bound_deg(product.equality.error)}};
  json["line"] = {{"coefficients_rad", coefficients_json(product.line.p)},
                  {"theta_error_deg", bound_deg(product.line.error)}};
  return json_text(json, 1);
}

bool names_output(const std::string& manifest, const std::string& name, const std::string& sha256) {
  const Json json = parse_foreign_json(manifest);
  if (!json.is_object() || !json.contains("outputs") || !json["outputs"].is_array()) return false;
  for (const Json& output : json["outputs"]) {
    if (output.is_object() && output.value("file", Json()) == name && output.value("sha256", Json()) == sha256)
      return true;
  }
  return false;
}

std::string model_manifest_json(const ModelProduct& product, const std::vector<OutputFile>& outputs) {
  Json json = {{"schema", 1}, {"tool", std::string(k_tool)}};
  json["status"] = all_ok(product.checks) ? "done" : "check_failed";
  json["input"] = input_json(product.file);
  json["name"] = product.mechanism.name;
  json["simulators_follow"] = word(product.curves.physical.source);
  json["table_follows"] = word(product.curves.sensed.source);
  json["notes"] = product.notes;
  json["checks"] = Json::array();
  for (const Check& check : product.checks)
    json["checks"].push_back({{"name", check.name},
                              {"value", result_json(check.value)},
                              {"limit", number_of(rounded(check.limit, 6))},
                              {"unit", check.unit},
                              {"ok", check.ok}});
  json["outputs"] = output_list(outputs);
  return json_text(json, 1);
}

}  // namespace fusee::formats
