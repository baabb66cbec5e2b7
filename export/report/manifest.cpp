// manifest.json: the input, the measurements of the result, and the SHA-256 of every other file.

#include <cmath>

#include "base/output_list.h"
#include "export/mesh_files/mesh_files.h"
#include "export/report/derived.h"
#include "export/report/input_json.h"
#include "export/report/report.h"
#include "export/report/tendon_lengths.h"
#include "export/report/under_load.h"
#include "export/tool.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee::formats {
namespace {

/// Rounded to a micrometre.
Json to_micrometre(double millimetres) { return std::round(1000.0 * millimetres) / 1000.0; }

/// Every number as declared, in the file's units, with defaults and --set, which the input file alone does not contain.
Json mechanism_json(const DeclaredMechanism& mechanism) {
  Json tables = Json::object();
  for (const Field& field : fields()) {
    if (!is_used(field, mechanism) || field.table == "transmission") continue;
    if (field.is_set != nullptr && !field.is_set(mechanism)) continue;
    Json& table = field.table.empty() ? tables : tables[std::string(field.table)];
    table[std::string(field.key)] = field_value(field, mechanism);
  }
  return tables;
}

/// The design values that differ from the declared ones, because the joint was identified.
Json derived_json(const Product& product) {
  const DerivedNumbers derived = derived_numbers(product.file.mechanism, product.joint);
  Json keys = Json::object();
  for (const Field* field : derived.fields)
    keys[field->name()] = {{"declared", field_value(*field, product.file.mechanism)},
                           {"made", field_value(*field, derived.made)}};
  return keys;
}

Json checks_json(const std::vector<Check>& checks) {
  Json list = Json::array();
  for (const Check& check : checks) {
    Json entry = {{"name", check.name},
                  {"value", result_json(check.value)},
                  {"limit", result_json(check.limit)},
                  {"unit", check.unit},
                  {"ok", check.ok}};
    if (!check.where.empty()) entry["where"] = check.where;
    list.push_back(std::move(entry));
  }
  return list;
}

Json as_built_json(const profile::RewindResult& as_built) {
  return {{"max_theta_error_deg", angle_json(as_built.max_theta_error)},
          {"max_theta_error_at_alpha_deg", angle_json(as_built.max_theta_error_at)},
          {"max_slack_mm", result_json(as_built.max_excess)},
          {"max_slack_at_alpha_deg", angle_json(as_built.max_excess_at)}};
}

Json fleet_json(const helical_solid::HelicalRewind& as_built) {
  return {{"max_fleet_angle_deg", angle_json(as_built.max_fleet)},
          {"max_fleet_angle_at_alpha_deg", angle_json(as_built.max_fleet_at)}};
}

/// The grooves' planes in the written mesh, with shrinkage compensation.
Json grooves_json(const solid::BodyLayout& layout) {
  return {{{"pulley", "P1"}, {"z_mm", result_json(layout.z_p1 * layout.scale)}},
          {{"pulley", "P2"}, {"z_mm", result_json(layout.z_p2 * layout.scale)}}};
}

/// A helical groove. Heights are those of the written mesh, above its lower face. z_mm: the middle of the working arc.
Json helical_groove_json(const Product& product, transmission::Side which) {
  const bool left = which == transmission::Side::left;
  const helix::HelixSide& side = product.helix->synthesis.sides.at(left ? 0 : 1);
  const helical_solid::SpiralPlace& place = left ? product.helix->pulley.p1 : product.helix->pulley.p2;
  const double scale = product.pulley.layout.scale;
  const auto height = [&](double z) { return result_json(scale * place.height(z)); };
  const double first = side.spiral.rows.at(side.spiral.first_used).z,
               last = side.spiral.rows.at(side.spiral.last_used).z;
  return {{"pulley", transmission::pulley_name(which)},
          {"z_mm", height(0.5 * (first + last))},
          {"z_first_mm", height(first)},
          {"z_last_mm", height(last)},
          {"turns", result_json(side.turns)},
          {"lead_mm", result_json(side.lead)},
          {"joint_end_z_mm", height(side.attachment_z)},
          {"max_fleet_angle_deg", angle_json(side.fleet)}};
}

Json helical_grooves_json(const Product& product) {
  return {helical_groove_json(product, transmission::Side::left),
          helical_groove_json(product, transmission::Side::right)};
}

/// Length to cut for the rig of `fusee kit`; null without a rig.
Json cut_in_rig(const Product& product, transmission::Side side) {
  if (!product.rig) return nullptr;
  for (const KitCut& cut : rig_cuts(product, *product.rig)) {
    if (cut.side == side) return result_json(cut.cut);
  }
  return nullptr;
}

Json size_json(const solid::Pulley& pulley) {
  const solid::OuterSize size = solid::outer_size(pulley);
  return {{"diameter_mm", to_micrometre(size.diameter)}, {"height_mm", to_micrometre(size.height)}};
}

Json tendons_json(const Product& product) {
  Json list = Json::array();
  for (const TendonLength& tendon : tendon_lengths(product)) {
    const bool left = tendon.side == transmission::Side::left;
    list.push_back({{"tendon", left ? 1 : 2},
                    {"pulley", transmission::pulley_name(tendon.side)},
                    {"between_knots_mm", to_micrometre(tendon.between_knots)},
                    {"cut_length_mm", result_json(tendon.cut)},
                    {"cut_length_in_test_rig_mm", cut_in_rig(product, tendon.side)},
                    {"joint_knot_mm", {to_micrometre(tendon.joint_knot.x()), to_micrometre(tendon.joint_knot.y())}},
                    {"pulley_knot_mm",
                     {to_micrometre(tendon.pulley_knot.x()), to_micrometre(tendon.pulley_knot.y()),
                      to_micrometre(tendon.pulley_knot.z())}},
                    {"spare_wrap_turns", result_json(tendon.spare_lap / k_two_pi)}});
  }
  return list;
}

/// The parts to print, in print orientation.
Json print_json(const solid::Pulley& pulley) {
  Json list = Json::array();
  if (pulley.parts.empty()) list.push_back({{"file", "pulley.stl"}});
  for (const solid::PrintedPart& part : pulley.parts)
    list.push_back({{"file", part_file_name(part.side)}, {"part", transmission::pulley_name(part.side)}});
  return list;
}

/// The largest loads of the knots on the pulley.
Json knots_json(const Product& product) {
  const solid::Holding& holding = product.holding;
  const auto number_or_null = [](const std::optional<double>& value) {
    return value ? result_json(*value) : Json(nullptr);
  };
  Json list = Json::array();
  for (const solid::KnotHold& knot : holding.knots) {
    list.push_back({{"tendon", knot.side == transmission::Side::left ? 1 : 2},
                    {"alpha_deg", angle_json(knot.alpha)},
                    {"wrap_left_deg", angle_json(knot.wrap_left)},
                    {"tension_N", result_json(knot.tension)},
                    {"at_knot_N", result_json(knot.at_knot)},
                    {"strength_N", holding.strength ? result_json(holding.strength->tension) : Json(nullptr)},
                    {"strength_source", holding.strength ? Json(holding.strength->source) : Json(nullptr)},
                    {"efficiency", result_json(product.joint.mechanism.tendon.knot_efficiency)},
                    {"share", number_or_null(holding.share(knot))}});
  }
  return list;
}

Json notes_json(const Product& product) {
  Json notes = Json::array();
  for (const Diagnostic& warning : product.file.warnings) notes.push_back(warning.message);
  for (const std::string& warning : product.synthesis.warnings) notes.push_back(warning);
  for (const std::string& warning : product.holding.warnings) notes.push_back(warning);
  for (const std::string& note : product.pulley.layout.notes) notes.push_back(note);
  return notes;
}

}  // namespace

std::string manifest_json(const Product& product, const std::vector<OutputFile>& outputs) {
  Json manifest;
  manifest["schema"] = 1;
  manifest["tool"] = k_tool;
  manifest["status"] = all_ok(product.checks) ? "done" : "check_failed";
  manifest["input"] = input_json(product.file);
  manifest["grooves"] = product.helix ? helical_grooves_json(product) : grooves_json(product.pulley.layout);
  manifest["tendon"] = {{"diameter_mm", result_json(product.joint.mechanism.tendon.diameter)}};
  manifest["size"] = size_json(product.pulley);
  manifest["print"] = print_json(product.pulley);
  manifest["as_built"] = as_built_json(product.as_built);
  if (product.helix) manifest["as_built"].update(fleet_json(product.helix->as_built));
  manifest["under_load"] = under_load_json(product.under_load);
  if (product.under_load.motor) manifest["motor"] = motor_json(*product.under_load.motor);
  manifest["tendons_at_home"] = tendons_json(product);
  manifest["knots"] = knots_json(product);
  manifest["mechanism"] = mechanism_json(product.file.mechanism);
  if (const Json derived = derived_json(product); !derived.empty()) manifest["derived"] = derived;
  manifest["notes"] = notes_json(product);
  manifest["checks"] = checks_json(product.checks);
  manifest["outputs"] = output_list(outputs);
  // A name that is no UTF-8 is written with U+FFFD in place of invalid bytes.
  return json_text(manifest, 1);
}

}  // namespace fusee::formats
