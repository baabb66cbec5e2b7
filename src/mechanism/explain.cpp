#include <algorithm>

#include "base/json.h"
#include "base/text.h"
#include "fusee/mechanism_file.h"
#include "mechanism/catalogue.h"
#include "mechanism/field_text.h"
#include "mechanism/lengths.h"

namespace fusee {
namespace {

/// Keys whose explanation has this word, such as "dyneema"; "" if there is none.
std::string keys_with(std::string_view word) {
  constexpr std::size_t k_least_letters = 3, k_most_keys = 4;
  if (word.size() < k_least_letters) return {};
  std::string keys;
  std::size_t count = 0;
  for (const Field& field : fields()) {
    if (lower(explain(field.name())).find(lower(word)) == std::string::npos) continue;
    if (count++ < k_most_keys) keys += (keys.empty() ? "" : ", ") + field.name();
  }
  return count > k_most_keys ? keys + " or " + std::to_string(count - k_most_keys) + " more" : keys;
}

/// The fields that match a word: a dotted name, a key (in every table that has it), a table, or all for "".
std::vector<const Field*> matching_fields(std::string_view word) {
  std::vector<const Field*> found;
  const std::vector<std::string> tables = field_tables();
  const bool is_table = !word.empty() && std::find(tables.begin(), tables.end(), word) != tables.end();
  std::vector<std::string> names = tables;
  for (const Field& field : fields()) {
    const bool matches = is_table ? field.table == word : field.name() == word || field.key == word;
    if (word.empty() || matches) found.push_back(&field);
    names.push_back(field.name());
    names.emplace_back(field.key);
  }
  if (!found.empty()) return found;
  const std::string nearest = nearest_word(word, names);
  const std::string keys = nearest.empty() ? keys_with(word) : "";
  throw InputError("", "there is no key " + in_quotes(word),
                   !nearest.empty() ? "did you mean " + nearest + "?"
                   : !keys.empty()  ? "the word occurs in fusee explain " + keys
                                    : "fusee explain lists all keys");
}

/// One entry of the catalogue.
std::string entry(const std::string& words) { return wrapped(words, "    ", "      "); }

std::string horn_words(const Horn& horn) {
  if (horn.spline_teeth > 0) {
    return std::to_string(horn.spline_teeth) + " teeth, " + shortest(horn.spline_diameter) + " mm over them, " +
           shortest(horn.spline_depth) + " mm deep";
  }
  std::string text = std::to_string(horn.bolt_count) + " holes of " + shortest(horn.bolt_hole) + " mm on " +
                     shortest(horn.bolt_circle) + " mm";
  if (horn.boss_height > 0) {
    text += ", a boss of " + shortest(horn.boss_diameter) + " mm, " + shortest(horn.boss_height) + " mm high";
  }
  return text;
}

std::string horn_list() {
  std::string text = "  Known horns (profiles/catalogue/horns.toml):\n";
  for (const HornType& type : horns())
    text += entry(type.name + ": " + type.description + "; " + horn_words(type.horn) + ". " + type.source);
  return text;
}

std::string shaft_list() {
  std::string text = "  Known shafts (profiles/catalogue/shafts.toml):\n";
  for (const ShaftType& type : shafts()) {
    text += entry(type.name + ": " + type.description + "; " + shortest(type.diameter) + " mm" +
                  (type.flat > 0 ? ", " + shortest(type.flat) + " mm over the flat" : "") + ". " + type.source);
  }
  return text;
}

std::string tendon_list() {
  std::string text = "  Known tendons (profiles/catalogue/tendons.toml):\n";
  for (const TendonType& type : tendon_types()) {
    text += entry(type.name + ": diameter_mm = " + shortest(type.diameter) +
                  ", modulus_MPa = " + shortest(type.modulus) + ", bend_ratio = " + shortest(type.bend_ratio) +
                  "; breaks at " + shortest(type.breaking_strength) + " N. " + type.description + ". " + type.source);
  }
  return text;
}

std::string motor_list() {
  std::string text = "  Known motors (profiles/catalogue/motors.toml):\n";
  for (const MotorModel& model : motor_models()) {
    const std::string travel = model.travel > 0 ? rounded(degrees(model.travel), 10) + " deg" : "turns without end";
    const std::string speed = model.speed > 0 ? ", " + rounded(degrees(model.speed), 10) + " deg/s" : "";
    text += entry(model.name + ": " + travel + ", " + shortest(model.stall_torque) + " Nmm" +
                  (model.holds ? " held" : " at stall") + speed + ". " + model.description + ". " + model.source);
  }
  return text;
}

std::string material_list() {
  std::string text = "  Known materials (profiles/catalogue/materials.toml):\n";
  for (const MaterialType& type : material_types()) {
    text += entry(type.name + ": shrinks " + shortest(type.shrinkage_least) + " to " + shortest(type.shrinkage_most) +
                  " %, typically " + shortest(type.shrinkage_typical) + " %. " + type.description + ". " + type.source);
  }
  return text;
}

/// The part of the catalogue that is useful for a key.
std::string catalogue_text(const Field& field) {
  if (field.name() == "body.horn") return horn_list();
  if (field.name() == "body.shaft") return shaft_list();
  if (field.name() == "motor.model") return motor_list();
  if (field.table == "tendon" && field.key != "pretension_N") return tendon_list();
  if (field.name() == "material.name" || field.name() == "material.shrinkage_percent") return material_list();
  return {};
}

constexpr std::string_view k_length_words =
    "or a text with its unit: \"45 mm\", \"4.5 cm\", \"3 1/2 in\". Numbers are in inches with units = \"inch\"";

std::string field_text(const Field& field) {
  std::string text = field.name();
  if (!field.symbol.empty()) text += "  (" + std::string(field.symbol) + ")";
  text += "\n" + wrapped(field.meaning, "  ", "  ") + wrapped(kind_text(field), "  is       ", "           ");
  const bool is_horn = field.name() == "body.horn";  // a text, as [horn] describes others
  if (field.kind != FieldKind::choice && field.kind != FieldKind::boolean)
    text += wrapped(is_horn ? "own, or a name in the list below" : allowed_text(field), "  allowed  ", "           ");
  if (is_length(field.key)) text += wrapped(k_length_words, "  ", "  ");
  return text + wrapped(default_text(field), "  ", "  ");
}

/// A list of keys, grouped by table.
std::string list_text(const std::vector<const Field*>& list) {
  std::size_t width = 0;
  for (const Field* field : list) width = std::max(width, field->key.size());
  std::string text;
  std::string_view table = "?";  // the name of no table
  for (const Field* field : list) {
    if (field->table != table) {
      const std::string head = field->table.empty() ? "at the top" : "[" + std::string(field->table) + "]";
      text += (text.empty() ? "" : "\n") + wrapped(table_meaning(field->table), head + "  ", "  ");
      table = field->table;
    }
    text += wrapped(std::string(field->meaning) + " (" + default_text(*field) + ")",
                    "  " + std::string(field->key) + std::string(width - field->key.size() + 2, ' '),
                    std::string(width + 4, ' '));
  }
  return text;
}

Json field_json(const Field& field) {
  Json json;
  json["name"] = field.name();
  json["table"] = field.table;
  json["key"] = field.key;
  json["symbol"] = field.symbol;
  constexpr const char* k_kinds[] = {"number", "range", "choice", "text", "boolean", "numbers", "texts", "point"};
  json["kind"] = k_kinds[static_cast<int>(field.kind)];
  json["unit"] = field.unit;
  json["length"] = is_length(field.key);  // may be in inches, or a text with its unit
  json["required"] = field.required;
  json["only_when"] = field.only_when;
  json["default"] = field.fallback;
  if (field.kind == FieldKind::number || field.kind == FieldKind::range || field.kind == FieldKind::numbers ||
      field.kind == FieldKind::point) {
    json["least"] = field.least;
    json["most"] = field.most;
  }
  if (!field.choices.empty()) json["choices"] = field.choices;
  json["meaning"] = field.meaning;
  if (field.name() == "body.horn") {  // any text, but usually one of these
    json["known"] = {k_own_horn};
    for (const HornType& type : horns()) json["known"].push_back(type.name);
  }
  return json;
}

Json catalogue_json() {
  Json json;
  for (const HornType& type : horns()) {
    Json horn = {{"name", type.name}, {"description", type.description}, {"source", type.source}};
    Mechanism mechanism;
    mechanism.horn = type.horn;
    for (const Field& field : fields()) {
      if (field.table == "horn") horn[std::string(field.key)] = number_of(mechanism, field);
    }
    json["horns"].push_back(std::move(horn));
  }
  for (const ShaftType& type : shafts()) {
    json["shafts"].push_back({{"name", type.name},
                              {"description", type.description},
                              {"source", type.source},
                              {"diameter_mm", type.diameter},
                              {"flat_mm", type.flat}});
  }
  for (const TendonType& type : tendon_types()) {
    json["tendons"].push_back({{"name", type.name},
                               {"description", type.description},
                               {"source", type.source},
                               {"diameter_mm", type.diameter},
                               {"modulus_MPa", type.modulus},
                               {"breaking_strength_N", type.breaking_strength},
                               {"bend_ratio", type.bend_ratio}});
  }
  for (const MaterialType& type : material_types()) {
    json["materials"].push_back({{"name", type.name},
                                 {"description", type.description},
                                 {"source", type.source},
                                 {"shrinkage_least_percent", type.shrinkage_least},
                                 {"shrinkage_typical_percent", type.shrinkage_typical},
                                 {"shrinkage_most_percent", type.shrinkage_most}});
  }
  for (const MotorModel& model : motor_models()) {
    json["motors"].push_back({{"name", model.name},
                              {"description", model.description},
                              {"source", model.source},
                              {"travel_deg", number_of(rounded(degrees(model.travel), 12))},
                              {"stall_torque_Nmm", model.stall_torque},
                              {"speed_deg_per_s", number_of(rounded(degrees(model.speed), 12))},
                              {"holds", model.holds}});
  }
  return json;
}

}  // namespace

std::string explain(std::string_view key) {
  const std::vector<const Field*> list = matching_fields(key);
  const bool one_key = !key.empty() && (list.front()->key == key || list.front()->name() == key);
  if (!one_key) return list_text(list);
  std::string text;
  for (const Field* field : list) text += (text.empty() ? "" : "\n") + field_text(*field) + catalogue_text(*field);
  return text;
}

std::string explain_json(std::string_view key) {
  Json json;
  json["schema"] = 1;
  for (const Field* field : matching_fields(key)) json["fields"].push_back(field_json(*field));
  json["catalogue"] = catalogue_json();
  return json_text(json, 2);
}

}  // namespace fusee
