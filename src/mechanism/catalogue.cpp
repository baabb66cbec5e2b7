#include "mechanism/catalogue.h"

#include <toml++/toml.h>

#include <algorithm>
#include <type_traits>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"
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

double number_or_zero(const toml::table& item, std::string_view key) {
  return item.contains(key) ? number(item, key) : 0.0;
}

/// A horn has the keys and units of [horn] in a mechanism file.
HornType make(const toml::table& item, HornType type) {
  DeclaredMechanism mechanism;
  for (const Field& field : fields()) {
    if (field.table == "horn" && item.contains(field.key)) field.set(mechanism, 0, number(item, field.key));
  }
  type.horn = mechanism.horn;
  return type;
}

ShaftType make(const toml::table& item, ShaftType type) {
  type.flat = number_or_zero(item, "flat_mm");
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

BearingType make(const toml::table& item, BearingType type) {
  type.bore = number(item, "bore_mm");
  type.outer = number(item, "outer_mm");
  type.width = number(item, "width_mm");
  type.spacer = number(item, "spacer_mm");
  return type;
}

BoardType make(const toml::table& item, BoardType type) {
  type.size = {number(item, "size_x_mm"), number(item, "size_y_mm")};
  type.thickness = number(item, "thickness_mm");
  type.pitch = {number(item, "pitch_x_mm"), number(item, "pitch_y_mm")};
  type.hole = number(item, "hole_mm");
  type.chip = number(item, "chip_mm");
  type.magnet = number(item, "magnet_mm");
  type.magnet_height = number(item, "magnet_height_mm");
  type.gap = number(item, "gap_mm");
  return type;
}

std::vector<std::string> names_of_fits(const toml::table& item) {
  std::vector<std::string> names;
  if (const toml::array* fits = item["fits"].as_array()) {
    for (const toml::node& name : *fits) names.push_back(name.value_or(std::string()));
  }
  return names;
}

MotorType make(const toml::table& item, MotorType type) {
  type.fits = names_of_fits(item);
  type.shaft = number_or_zero(item, "shaft_mm");
  type.shaft_length = number_or_zero(item, "shaft_length_mm");
  type.face = number_or_zero(item, "face_mm");
  type.front = number(item, "front_mm");
  type.back = number(item, "back_mm");
  type.side = number(item, "side_mm");
  type.depth = number(item, "depth_mm");
  type.pilot = number(item, "pilot_mm");
  type.two_holes = number_or_zero(item, "two_holes") != 0;
  type.hole_x = number(item, "hole_x_mm");
  type.hole_front = number(item, "hole_front_mm");
  type.hole_back = number(item, "hole_back_mm");
  type.hole = number(item, "hole_mm");
  type.head = number(item, "head_mm");
  return type;
}

MotorModel make(const toml::table& item, MotorModel model) {
  model.fits = names_of_fits(item);
  model.travel = radians(number_or_zero(item, "travel_deg"));
  model.stall_torque = number(item, "stall_torque_Nmm");
  model.speed = radians(number_or_zero(item, "speed_deg_per_s"));
  model.holds = number_or_zero(item, "holds") != 0;
  return model;
}

TemplateType make(const toml::table& item, TemplateType type) {
  type.group = text(item, "group");
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
      if constexpr (!std::is_same_v<Item, TemplateType>) item.source = text(table, "source");
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

const std::vector<BearingType>& bearing_types() {
  static const std::vector<BearingType> all = load<BearingType>("bearings", "bearing");
  return all;
}

const std::vector<BoardType>& board_types() {
  static const std::vector<BoardType> all = load<BoardType>("boards", "board");
  return all;
}

const std::vector<MotorType>& motor_types() {
  static const std::vector<MotorType> all = load<MotorType>("motors", "motor");
  return all;
}

const std::vector<MotorModel>& motor_models() {
  static const std::vector<MotorModel> all = load<MotorModel>("motors", "model");
  return all;
}

const std::vector<TemplateType>& template_types() {
  static const std::vector<TemplateType> all = load<TemplateType>("templates", "template");
  return all;
}

const HornType* find_horn(std::string_view name) { return find(horns(), name); }
const ShaftType* find_shaft(std::string_view name) { return find(shafts(), name); }

const MotorModel* find_motor_model(std::string_view name) { return find(motor_models(), name); }

bool fits_bore(const MotorModel& model, const Body& body) {
  return std::any_of(model.fits.begin(), model.fits.end(), [&body](const std::string& name) {
    return name == body.shaft || (body.bore == Bore::horn && name == body.horn);
  });
}

const MotorModel* strongest_motor_that_fits(const Body& body) {
  const MotorModel* strongest = nullptr;
  for (const MotorModel& model : motor_models())
    if (fits_bore(model, body) && (strongest == nullptr || model.stall_torque > strongest->stall_torque))
      strongest = &model;
  return strongest;
}

double strength_by_section(const TendonType& type, double diameter) {
  const double diameter_ratio = diameter / type.diameter;
  return type.breaking_strength * diameter_ratio * diameter_ratio;
}

MotorModel motor_limits(const Motor& motor) {
  const MotorModel* known = find_motor_model(motor.model);
  MotorModel limits = known == nullptr ? MotorModel{} : *known;
  if (motor.travel > 0) limits.travel = motor.travel;
  if (motor.speed > 0) limits.speed = motor.speed;
  if (motor.stall_torque > 0) {
    limits.stall_torque = motor.stall_torque;
    limits.holds = false;  // [motor] states the torque of a stall, not a continuous one
  }
  return behind_gearbox(limits, motor);
}

MotorModel behind_gearbox(MotorModel model, const Motor& motor) {
  if (motor.gear_ratio == 1) return model;
  model.name += (model.name.empty() ? "" : " ") + rounded(motor.gear_ratio) + ":1";
  model.travel /= motor.gear_ratio;
  model.speed /= motor.gear_ratio;
  model.stall_torque *= motor.gear_ratio * motor.gear_efficiency;
  return model;
}

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
