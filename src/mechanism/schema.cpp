#include <charconv>

#include "base/json.h"
#include "fusee/mechanism_file.h"
#include "mechanism/catalogue.h"
#include "mechanism/field_text.h"
#include "mechanism/lengths.h"

namespace fusee {
namespace {

/// An object that admits no unknown keys. Its keys are added to "properties" later.
Json closed_object(std::string_view description) {
  return {{"type", "object"},
          {"description", description},
          {"properties", Json::object()},
          {"additionalProperties", false}};
}

/// TOML's numbers, strings and booleans are valid JSON.
Json fallback_json(const Field& field) { return parse_json(field.fallback); }

/// A number; with `may_be_length` also a text with its unit. The bounds of lengths depend on `units`: length_bounds().
Json number_schema(const Field& field, bool may_be_length) {
  if (!may_be_length)
    return {{"type", field.whole ? "integer" : "number"}, {"minimum", field.least}, {"maximum", field.most}};
  constexpr const char* k_text =
      "^ *[-+]?([0-9.]+|([0-9]+[- ] *)?[0-9]+/[0-9]+)(e[-+]?[0-9]+)? *"
      "(mm|cm|m|um|\xC2\xB5m|in\\.?|inch|inches|\"|\xE2\x80\xB3|thou) *$";
  Json number = {{"type", "number"}}, text = {{"type", "string"}, {"pattern", k_text}};
  return {{"anyOf", {number, text}}};
}

/// The bounds of all lengths that are numbers, in a file of `units`.
Json length_bounds(LengthUnit units) {
  Json bounds = Json::object();
  for (const Field& field : fields()) {
    if (!is_length(field.key) || field.kind == FieldKind::numbers) continue;
    Json number = {{"minimum", from_mm(field.least, units)}, {"maximum", from_mm(field.most, units)}};
    Json& key = bounds["properties"][std::string(field.table)]["properties"][std::string(field.key)];
    if (field.kind == FieldKind::point)
      key["items"] = std::move(number);
    else
      key = std::move(number);
  }
  return bounds;
}

Json bounds_by_units() {
  Json in_inches = {{"required", {"units"}}};
  in_inches["properties"]["units"]["const"] = "inch";
  return {{"if", in_inches}, {"then", length_bounds(LengthUnit::inch)}, {"else", length_bounds(LengthUnit::mm)}};
}

Json field_schema(const Field& field) {
  Json json;
  json["title"] = field.symbol.empty() ? field.name() : field.name() + " (" + std::string(field.symbol) + ")";
  json["description"] = std::string(field.meaning) + (field.unit.empty() ? "" : ", " + std::string(field.unit)) + "; " +
                        default_text(field);
  const Json number = number_schema(field, is_length(field.key));
  switch (field.kind) {
    case FieldKind::number:
      json.update(number);
      break;
    case FieldKind::range:
    case FieldKind::point:
      json["type"] = "array";
      json["items"] = number;
      json["minItems"] = json["maxItems"] = 2;
      break;
    case FieldKind::choice:
      json["enum"] = field.choices;
      break;
    case FieldKind::text:
      json["type"] = "string";
      break;
    case FieldKind::boolean:
      json["type"] = "boolean";
      break;
    case FieldKind::numbers:
      json.update({{"type", "array"},
                   {"items", field.table == "optimize" ? number_schema(field, /*may_be_length=*/true) : number}});
      break;
    case FieldKind::texts: {
      Json one = {{"type", "string"}};
      if (!field.choices.empty()) one["enum"] = field.choices;
      json["anyOf"] = {one, {{"type", "array"}, {"items", one}}};
      break;
    }
  }
  if (field.name() == "body.horn") {
    json["enum"] = {k_own_horn};
    for (const HornType& type : horns()) json["enum"].push_back(type.name);
  }
  if (!field.fallback.empty()) json["default"] = fallback_json(field);
  return json;
}

/// "pulley.law=linear" → if law is "linear" (or absent, when that is the default) the key is required.
Json condition_schema(const Field& field) {
  const std::size_t equals = field.only_when.find('=');
  const Field* decider = find_field(field.only_when.substr(0, equals));
  const std::string value(field.only_when.substr(equals + 1));
  const bool by_default = decider->fallback == "\"" + value + "\"";
  Json condition = {{"properties", {{decider->key, {{"const", value}}}}}};
  if (!by_default) condition["required"] = {decider->key};
  return {{"if", condition}, {"then", {{"required", {field.key}}}}};
}

/// Requires joint, guides, pulley and tendon, or [transmission] in place of joint, guides, sheath and pulley.
Json either_joint() {
  Json condition;
  condition["if"] = {{"required", {"transmission"}}};
  for (const char* table : {"joint", "guides", "sheath", "pulley"})
    condition["then"]["not"]["anyOf"].push_back({{"required", {table}}});
  condition["else"] = {{"required", {"joint", "guides", "pulley", "tendon"}}};
  condition["else"]["properties"]["tendon"]["required"] = {"diameter_mm"};
  return condition;
}

}  // namespace

std::string mechanism_schema() {
  Json schema = closed_object(
      "A tendon-driven joint and the pulley that drives it. Lengths in mm or in `units`, angles in degrees, forces in "
      "N.");
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = "fusee mechanism file";
  for (const Field& field : fields()) {
    const std::string table(field.table);
    if (!table.empty() && !schema["properties"].contains(table))
      schema["properties"][table] = closed_object(table_meaning(table));
    Json& object = table.empty() ? schema : schema["properties"][table];
    object["properties"][std::string(field.key)] = field_schema(field);
    // A tendon may be omitted with [transmission]; either_joint() requires it otherwise.
    if ((field.required && table != "tendon") || field.needed_in_table) object["required"].push_back(field.key);
    if (field.fallback.empty() && !field.only_when.empty()) object["allOf"].push_back(condition_schema(field));
  }
  schema["allOf"].push_back(either_joint());
  schema["allOf"].push_back(bounds_by_units());
  return json_text(schema, 2);
}

}  // namespace fusee
