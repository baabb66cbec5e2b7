// bom.csv, manifest.json, and the tendons' lengths.

#include <cmath>
#include <filesystem>

#include "base/output_list.h"
#include "base/text.h"
#include "export/report/input_json.h"
#include "export/report/tendon_lengths.h"
#include "export/tool.h"
#include "fusee/base.h"
#include "fusee/export.h"
#include "mechanism/catalogue.h"
#include "mechanism/lengths.h"

namespace fusee::formats {
namespace {

/// A length, mm, rounded to a micrometre: the last digits of a sum are meaningless. Adding 0.0 turns −0 into 0.
double rounded_to_micrometre(double value) { return std::round(1000 * value) / 1000 + 0.0; }

std::string csv_quoted(const std::string& words) {
  std::string text = "\"";
  for (const char c : words) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

Json point_json(const Vec2& point) { return {rounded_to_micrometre(point.x()), rounded_to_micrometre(point.y())}; }

Json parts_json(const KitProduct& product) {
  Json list = Json::array();
  for (const kit::KitPart& part : product.plan.parts) {
    Json places = Json::array();
    for (const kit::KitPlace& place : part.places)
      places.push_back({{"x_mm", rounded_to_micrometre(place.shift.x())},
                        {"y_mm", rounded_to_micrometre(place.shift.y())},
                        {"z_mm", rounded_to_micrometre(place.z)},
                        {"turned_over", place.turned_over},
                        {"on_link", place.on_link}});
    list.push_back({{"name", part.name},
                    {"what", part.words},
                    {"count", part.count},
                    {"file", kit_file_name(part, "stl")},
                    {"also_cut", part.plate},
                    {"places", places}});
  }
  return list;
}

Json heights_json(const kit::TendonHeights& heights) {
  const auto span_json = [](const kit::TendonHeights::Span& span) {
    return Json{rounded_to_micrometre(span.low), rounded_to_micrometre(span.high)};
  };
  return {{"ends", {rounded_to_micrometre(heights.ends[0]), rounded_to_micrometre(heights.ends[1])}},
          {"guides", {span_json(heights.guides[0]), span_json(heights.guides[1])}},
          {"drum", span_json(heights.drum)}};
}

Json places_json(const kit::KitPlan& plan) {
  const kit::KitSizes& sizes = plan.sizes;
  if (plan.drilled) {
    Json places = {{"pins_mm", {point_json(plan.pins[0].place), point_json(plan.pins[1].place)}}};
    if (plan.heights) places["tendon_heights_mm"] = heights_json(*plan.heights);
    return places;
  }
  Json feet = Json::array();
  for (const Vec2& foot : plan.feet) feet.push_back(point_json(foot));
  return {{"pins_mm", {point_json(plan.pins[0].place), point_json(plan.pins[1].place)}},
          {"feet_mm", feet},
          {"pulley_z_mm", {rounded_to_micrometre(sizes.pulley_low), rounded_to_micrometre(sizes.pulley_high)}},
          {"tendon_z_mm", {rounded_to_micrometre(sizes.z_tendon1), rounded_to_micrometre(sizes.z_tendon2)}},
          {"scale_z_mm", rounded_to_micrometre(sizes.scale_low)},
          {"link_z_mm", rounded_to_micrometre(sizes.link_low)},
          {"bracket_z_mm", rounded_to_micrometre(sizes.bracket_low)},
          {"motor", sizes.motor_name.empty() ? Json(nullptr) : Json(sizes.motor_name)},
          {"motor_mount", sizes.motor ? Json(sizes.motor->name) : Json(nullptr)},
          {"bearing", sizes.bearing->name},
          {"board", sizes.board->name}};
}

}  // namespace

std::string kit_file_name(const kit::KitPart& part, const std::string& ending) { return part.name + "." + ending; }

std::vector<KitCut> rig_cuts(const Product& pulley, const std::array<kit::KitTendon, 2>& rig) {
  std::vector<KitCut> cuts;
  const double end_length = tendon_end(pulley.joint.mechanism.tendon);
  for (const TendonLength& tendon : tendon_lengths(pulley)) {
    const kit::KitTendon& on_rig = rig[tendon.side == transmission::Side::left ? 0 : 1];
    KitCut cut;
    cut.side = tendon.side;
    cut.between_knots = tendon.between_knots + on_rig.beyond;
    cut.cut = cut_length(cut.between_knots + on_rig.at_joint + 2 * end_length);
    cut.longer = cut.cut - tendon.cut;
    cuts.push_back(cut);
  }
  return cuts;
}

std::vector<KitCut> kit_cuts(const KitProduct& product) { return rig_cuts(product.pulley, product.plan.tendons); }

std::string bom_csv(const KitProduct& product) {
  std::string text = "count,item,use\n";
  const LengthUnit units = product.pulley.joint.mechanism.units;
  for (const kit::KitItem& item : product.plan.items)
    text += std::to_string(item.count) + "," + csv_quoted(lengths_in(units, item.what)) + "," +
            csv_quoted(lengths_in(units, item.use)) + "\n";
  for (const kit::KitPart& part : product.plan.parts)
    text += std::to_string(part.count) + "," + csv_quoted("print " + kit_file_name(part, "stl")) + "," +
            csv_quoted(part.words) + "\n";
  return text;
}

std::string kit_manifest_json(const KitProduct& product, const std::vector<OutputFile>& outputs) {
  Json json = {{"schema", 1}, {"tool", std::string(k_tool)}};
  json["status"] = all_ok(product.checks) ? "done" : "check_failed";
  json["input"] = input_json(product.pulley.file);
  json["name"] = product.pulley.joint.mechanism.name;
  json["places"] = places_json(product.plan);
  json["parts"] = parts_json(product);
  json["print"] = Json::array();
  for (const kit::KitPart& part : product.plan.parts) json["print"].push_back({{"file", kit_file_name(part, "stl")}});
  json["tendons_at_home"] = Json::array();
  for (const KitCut& cut : kit_cuts(product))
    json["tendons_at_home"].push_back({{"tendon", cut.side == transmission::Side::left ? 1 : 2},
                                       {"between_knots_mm", rounded_to_micrometre(cut.between_knots)},
                                       {"cut_length_mm", rounded_to_micrometre(cut.cut)},
                                       {"longer_than_without_rig_mm", rounded_to_micrometre(cut.longer)}});
  json["buy"] = Json::array();
  for (const kit::KitItem& item : product.plan.items)
    json["buy"].push_back({{"count", item.count}, {"item", item.what}, {"use", item.use}});
  json["notes"] = product.plan.notes;
  json["checks"] = Json::array();
  for (const Check& check : product.checks) {
    Json entry = {{"name", check.name},
                  {"value", result_json(check.value)},
                  {"limit", check.limit},
                  {"unit", check.unit},
                  {"ok", check.ok}};
    if (!check.where.empty()) entry["where"] = check.where;
    json["checks"].push_back(std::move(entry));
  }
  json["outputs"] = output_list(outputs);
  return json_text(json, 1);
}

}  // namespace fusee::formats
