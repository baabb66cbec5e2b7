#include "fusee/mechanism/catalogue.h"

#include <toml++/toml.h>

#include <algorithm>

#include "fusee/base/diagnostics.h"
#include "fusee/mechanism/fields.h"
#include "mechanism/embedded.h"

namespace fusee {
namespace {

double number(const toml::table& item, std::string_view key) {
  const std::optional<double> value = item[key].value<double>();
  demand(value.has_value(), "the catalogue lacks " + std::string(key));
  return *value;
}

std::string text(const toml::table& item, const char* key) {
  const std::optional<std::string> value = item[key].value<std::string>();
  demand(value.has_value() && !value->empty(), std::string("the catalogue lacks ") + key);
  return *value;
}

/// The keys of a horn are those of [horn] in a mechanism file, in its units.
HornType make(const toml::table& item, HornType type) {
  DeclaredMechanism mechanism;
  for (const Field& field : fields()) {
    if (field.table == "horn" && item.contains(field.key)) field.set(mechanism, 0, number(item, field.key));
  }
  type.horn = mechanism.horn;
  return type;
}

ShaftType make(const toml::table& item, ShaftType type) {
  type.flat = item.contains("flat_mm") ? number(item, "flat_mm") : 0;
  type.bore = type.flat > 0 ? Bore::d : Bore::round;
  type.diameter = number(item, "diameter_mm");
  return type;
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

template <class Item>
const Item* find(const std::vector<Item>& items, std::string_view name) {
  const auto found = std::find_if(items.begin(), items.end(), [name](const Item& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

const std::vector<HornType>& horns() {
  static const std::vector<HornType> all = load<HornType>("horns", "horn");
  return all;
}

const std::vector<ShaftType>& shafts() {
  static const std::vector<ShaftType> all = load<ShaftType>("shafts", "shaft");
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

const HornType* find_horn(std::string_view name) { return find(horns(), name); }
const ShaftType* find_shaft(std::string_view name) { return find(shafts(), name); }

const Horn& horn_of(const Mechanism& mechanism) {
  if (mechanism.body.horn == k_own_horn) return mechanism.horn;
  const HornType* type = find_horn(mechanism.body.horn);
  if (type == nullptr) {
    throw InputError("", "body.horn: there is no servo horn \"" + mechanism.body.horn + "\"",
                     "`fusee explain body.horn` lists them");
  }
  return type->horn;
}

}  // namespace fusee
