#include "fusee/mechanism/catalogue.h"

#include <toml++/toml.h>

#include "fusee/base/diagnostics.h"
#include "mechanism/embedded.h"

namespace fusee {
namespace {

double number(const toml::table& item, const char* key) {
  const std::optional<double> value = item[key].value<double>();
  demand(value.has_value(), std::string("the catalogue lacks ") + key);
  return *value;
}

std::string text(const toml::table& item, const char* key) {
  const std::optional<std::string> value = item[key].value<std::string>();
  demand(value.has_value() && !value->empty(), std::string("the catalogue lacks ") + key);
  return *value;
}

Horn make(const toml::table& item, Horn horn) {
  horn.hub_diameter = number(item, "hub_diameter_mm");
  horn.recess_depth = number(item, "recess_depth_mm");
  horn.centre_hole = number(item, "centre_hole_mm");
  horn.hole_count = static_cast<int>(number(item, "hole_count"));
  horn.hole_circle = number(item, "hole_circle_mm");
  horn.hole_diameter = number(item, "hole_diameter_mm");
  return horn;
}

TendonType make(const toml::table& item, TendonType type) {
  type.diameter = number(item, "diameter_mm");
  type.modulus = number(item, "modulus_MPa");
  type.breaking_strength = number(item, "breaking_strength_N");
  type.bend_ratio = number(item, "bend_ratio");
  return type;
}

MaterialType make(const toml::table& item, MaterialType type) {
  type.shrinkage_least = number(item, "shrinkage_least_percent");
  type.shrinkage_typical = number(item, "shrinkage_typical_percent");
  type.shrinkage_most = number(item, "shrinkage_most_percent");
  return type;
}

/// All [[key]] tables of one file of the catalogue.
template <class Item>
std::vector<Item> load(std::string_view file_name, const char* key) {
  std::vector<Item> items;
  for (const EmbeddedFile& file : embedded_catalogue()) {
    if (file.name != file_name) continue;
    const toml::table root = toml::parse(file.text);
    const toml::array* list = root[key].as_array();
    demand(list != nullptr, "the catalogue lacks " + std::string(key));
    for (const toml::node& node : *list) {
      const toml::table& table = *node.as_table();
      Item item;
      item.name = text(table, "name");
      item.description = text(table, "description");
      item.source = text(table, "source");
      items.push_back(make(table, std::move(item)));
    }
  }
  demand(!items.empty(), "no catalogue " + std::string(file_name));
  return items;
}

}  // namespace

const std::vector<Horn>& horns() {
  static const std::vector<Horn> all = load<Horn>("horns", "horn");
  return all;
}

const std::vector<TendonType>& tendon_types() {
  static const std::vector<TendonType> all = load<TendonType>("tendons", "tendon");
  return all;
}

const std::vector<MaterialType>& material_types() {
  static const std::vector<MaterialType> all = load<MaterialType>("materials", "material");
  return all;
}

const Horn* find_horn(const std::string& name) {
  for (const Horn& horn : horns()) {
    if (horn.name == name) return &horn;
  }
  return nullptr;
}

}  // namespace fusee
