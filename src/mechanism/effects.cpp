#include <algorithm>
#include <tuple>

#include "mechanism/effect.h"
#include "mechanism/effect_list.h"

namespace fusee {
namespace {

std::vector<Effect> in_order(JointKind kind) {
  std::vector<Effect> all = effect_list(kind);
  std::erase_if(
      all, [&](const Effect& effect) { return kind == JointKind::ratio ? effect.needs.tendons : effect.needs.ratio; });
  std::stable_sort(all.begin(), all.end(), [](const Effect& a, const Effect& b) {
    return std::tie(a.place, a.rank) < std::tie(b.place, b.rank);
  });
  return all;
}

double unconverted(double value) { return value; }
double percent(double fraction) { return 100.0 * fraction; }
double fraction(double percent) { return percent / 100.0; }
double from_ppm(double ppm) { return 1e-6 * ppm; }
/// The number that from_ppm() converts to exactly `fraction`. 1e6 * fraction misses it for some values.
double to_ppm(double fraction) { return fraction / 1e-6; }

}  // namespace

std::string_view word(ChainPlace place) {
  switch (place) {
    case ChainPlace::motor_sensor:
      return "motor sensor";
    case ChainPlace::shaft:
      return "shaft";
    case ChainPlace::pulley:
      return "pulley";
    case ChainPlace::tendon:
      return "tendon";
    case ChainPlace::sheath:
      return "sheath";
    case ChainPlace::pins:
      return "pins";
    case ChainPlace::joint:
      return "joint";
    case ChainPlace::joint_sensor:
      return "joint sensor";
  }
  return "";
}

std::string_view word(CorrectableBy remedy) {
  switch (remedy) {
    case CorrectableBy::nothing:
      return "";
    case CorrectableBy::table:
      return "table";
    case CorrectableBy::pulley:
      return "pulley";
  }
  return "";
}

JointKind kind_of(const Mechanism& mechanism) { return mechanism.transmission ? JointKind::ratio : JointKind::tendons; }

std::span<const Effect> effects(JointKind kind) {
  static const std::vector<Effect> of_tendons = in_order(JointKind::tendons), of_ratio = in_order(JointKind::ratio);
  return kind == JointKind::ratio ? of_ratio : of_tendons;
}

const Effect* find_effect(std::string_view name, JointKind kind) {
  const std::span<const Effect> all = effects(kind);
  const auto found = std::find_if(all.begin(), all.end(), [&](const Effect& effect) { return effect.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string_view word(HandTool tool) {
  switch (tool) {
    case HandTool::caliper:
      return "caliper";
    case HandTool::dial_gauge:
      return "dial_gauge";
    case HandTool::mark:
      return "mark";
    case HandTool::protractor:
      return "protractor";
    case HandTool::ruler:
      return "ruler";
    case HandTool::motor_sensor:
      return "motor_sensor";
  }
  return "";
}

double reading_by_hand(const EffectParameter& parameter, const Imperfections& joint, const Mechanism& declared) {
  return parameter.by_hand.read != nullptr ? parameter.by_hand.read(joint, declared) : value_of(joint, parameter);
}

double prior_of(const EffectParameter& parameter, double largest_load) {
  if (!(largest_load > 0)) return parameter.prior;
  switch (parameter.prior_unit) {
    case PriorUnit::own:
      return parameter.prior;
    case PriorUnit::at_largest_load:
      return parameter.prior / largest_load;
    case PriorUnit::of_largest_load:
      return parameter.prior * largest_load;
  }
  return parameter.prior;
}

double value_of(const Imperfections& joint, const EffectParameter& parameter) {
  Imperfections copy = joint;  // parameters are accessed through a mutable reference
  return parameter.number(copy);
}

bool is_idle(const EffectParameter& parameter, const Imperfections& joint) {
  return parameter.idle != nullptr && parameter.idle(joint);
}

double shown_value(const EffectParameter& parameter, const Imperfections& joint, const Mechanism& declared) {
  return is_idle(parameter, joint) ? 0.0 : parameter.shown(value_of(joint, parameter), declared);
}

void set_value(Imperfections& joint, const EffectParameter& parameter, double value) {
  parameter.number(joint) = value;
}

void reset(Imperfections& joint, const EffectParameter& parameter) {
  set_value(joint, parameter, value_of({}, parameter));
}

Imperfections merge_findings(const Imperfections& before, const Imperfections& found, JointKind kind) {
  Imperfections total = found;
  for (const Effect& effect : effects(kind)) {
    if (effect.merge != nullptr) {
      effect.merge(before, total);
      continue;
    }
    for (const EffectParameter& parameter : effect.parameters) {
      const double first = value_of(before, parameter), second = value_of(found, parameter);
      if (parameter.merge_rule == MergeRule::add) set_value(total, parameter, second + first);
      if (parameter.merge_rule == MergeRule::compound) set_value(total, parameter, (1 + first) * (1 + second) - 1);
    }
  }
  return total;
}

Imperfections changed(const Imperfections& before, const Imperfections& change, JointKind kind) {
  Imperfections after = before;
  // Joints declared by a ratio have no effect for the sensor's zero, which their file leaves free.
  after.sensor.zero += change.sensor.zero;
  for (const Effect& effect : effects(kind)) {
    const bool changes = std::any_of(effect.parameters.begin(), effect.parameters.end(),
                                     [&](const EffectParameter& p) { return !p.searched && value_of(change, p) != 0; });
    for (const EffectParameter& parameter : effect.parameters) {
      const double first = value_of(before, parameter), second = value_of(change, parameter);
      const double sum = std::clamp(first + second, parameter.least, parameter.most);
      if (changes) set_value(after, parameter, parameter.searched ? second : sum);
    }
  }
  return after;
}

Imperfections beyond_mechanism(const Imperfections& found, JointKind kind) {
  Imperfections remaining = found;
  for (const Effect& effect : effects(kind)) {
    for (const EffectParameter& parameter : effect.parameters) {
      if (parameter.merge_rule != MergeRule::replace) reset(remaining, parameter);
    }
  }
  return remaining;
}

namespace key {

IdentifiedKey plain(std::string_view name, std::string_view unit, double least, double most, std::string_view meaning) {
  return {name, unit, meaning, least, most, unconverted, unconverted};
}
IdentifiedKey in_degrees(std::string_view name, double least, double most, std::string_view meaning) {
  return {name, "deg", meaning, least, most, degrees_as_read, radians};
}
IdentifiedKey in_percent(std::string_view name, double least, double most, std::string_view meaning) {
  return {name, "%", meaning, least, most, percent, fraction};
}
IdentifiedKey in_ppm(std::string_view name, std::string_view meaning) {
  return {name, "ppm_per_K", meaning, -1e5, 1e5, to_ppm, from_ppm};
}

}  // namespace key

}  // namespace fusee
