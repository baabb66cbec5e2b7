#include "fusee/profile/advice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "fusee/base/text.h"
#include "fusee/mechanism/fields.h"

namespace fusee {
namespace {

/// A number of the file, or both ends of a range together, as one dial to turn.
struct Dial {
  std::string key;
  std::string symbol;
  std::string unit;
  double value = 0;
  double least = 0;
  double most = 0;
  /// How far a step of 100 % goes: the value's size, or a length of the joint for numbers near zero.
  double scale = 1;
  std::function<void(Mechanism&, double)> turn;
};

std::optional<Dial> number_dial(const Mechanism& mechanism, const std::string& key) {
  const Field* field = find_field(key);
  if (field == nullptr || field->kind != FieldKind::number) return std::nullopt;
  Dial dial;
  dial.key = key;
  dial.symbol = field->symbol.empty() ? key : std::string(field->symbol);
  dial.unit = field->unit;
  dial.value = number_of(mechanism, *field);
  dial.least = field->least;
  dial.most = field->most;
  dial.scale = std::max(std::abs(dial.value), field->unit == "mm" && field->least < 0 ? 0.1 * mechanism.joint.R : 0.0);
  dial.turn = [field](Mechanism& changed, double value) { set_number(changed, *field, 0, value); };
  return dial;
}

/// Both ends of a symmetric range together; else each end alone.
std::vector<Dial> range_dials(const Mechanism& mechanism) {
  const Field* field = find_field("joint.range_deg");
  if (field == nullptr) return {};
  const double low = number_of(mechanism, *field);
  const double high = number_of(mechanism, *field, 1);
  Dial both{"joint.range_deg", "the range", "deg", high, 0.5, field->most, high, {}};
  both.turn = [field](Mechanism& changed, double value) {
    set_number(changed, *field, 0, -value);
    set_number(changed, *field, 1, value);
  };
  if (std::abs(low + high) < 1e-9) return {both};
  Dial lower{"joint.range_deg[0]", "the range's lower end", "deg", low, field->least, 0.0, std::abs(low), {}};
  lower.turn = [field](Mechanism& changed, double value) { set_number(changed, *field, 0, value); };
  Dial upper{"joint.range_deg[1]", "the range's upper end", "deg", high, 0.0, field->most, std::abs(high), {}};
  upper.turn = [field](Mechanism& changed, double value) { set_number(changed, *field, 1, value); };
  return {lower, upper};
}

std::vector<Dial> dials(const Mechanism& mechanism, const std::vector<std::string>& more_keys) {
  std::vector<std::string> keys{"joint.length_mm", "guides.EB_mm",     "guides.ED_mm", "guides.OE_mm",
                                "guides.radius_mm", "pulley.EF_mm", "tendon.diameter_mm"};
  if (mechanism.pulley.law == Law::compensate) keys.insert(keys.begin(), "pulley.r1_mm");
  if (mechanism.pulley.law == Law::linear) keys.insert(keys.begin(), "pulley.ratio");
  keys.insert(keys.end(), more_keys.begin(), more_keys.end());
  std::vector<Dial> all;
  for (const std::string& key : keys) {
    if (const auto dial = number_dial(mechanism, key)) all.push_back(*dial);
  }
  for (const Dial& dial : range_dials(mechanism)) all.push_back(dial);
  return all;
}

/// `value` to three digits: nearest, and next towards `direction`.
std::array<double, 2> in_three_digits(double value, double direction) {
  if (value == 0) return {0, 0};
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2.0);
  const double scaled = value / unit;
  return {std::round(scaled) * unit, (direction > 0 ? std::ceil(scaled) : std::floor(scaled)) * unit};
}

/// The value nearest to the dial's, in one direction (+1, −1), with which `possible` holds.
std::optional<double> nearest_value(const Mechanism& mechanism, const Dial& dial, double direction,
                                    const std::function<bool(const Mechanism&)>& possible) {
  if (!(dial.scale > 0)) return std::nullopt;
  const auto holds = [&](double value) {
    Mechanism changed = mechanism;
    dial.turn(changed, value);
    return possible(changed);
  };
  double bad = dial.value;
  double step = 0.005;
  while (step < 40.0) {
    const double good = std::clamp(dial.value + direction * step * dial.scale, dial.least, dial.most);
    if (good == bad) return std::nullopt;
    if (!holds(good)) {
      bad = good;
      step *= 1.3;
      continue;
    }
    double near = good;
    for (int i = 0; i < 24 && std::abs(near - bad) > 1e-4 * dial.scale; ++i) {
      const double middle = 0.5 * (near + bad);
      (holds(middle) ? near : bad) = middle;
    }
    for (const double plain : in_three_digits(near, direction)) {
      if (plain >= dial.least && plain <= dial.most && holds(plain)) return plain;
    }
    return near;
  }
  return std::nullopt;
}

std::string change_text(const Dial& dial, double to) {
  const std::string amount = rounded(to, 3);
  if (dial.symbol == "the range") return "the range ±" + amount + "°";
  const std::string unit = dial.unit == "deg" ? "°" : dial.unit.empty() ? "" : " " + dial.unit;
  return dial.symbol + (to > dial.value ? " ≥ " : " ≤ ") + amount + unit;
}

}  // namespace

std::vector<Change> nearest_changes(const Mechanism& mechanism, const std::function<bool(const Mechanism&)>& possible,
                                    const std::vector<std::string>& more_keys) {
  struct Ranked {
    Change change;
    double distance;
  };
  std::vector<Ranked> found;
  for (const Dial& dial : dials(mechanism, more_keys)) {
    std::optional<Ranked> nearest;
    for (const double direction : {-1.0, 1.0}) {
      const auto to = nearest_value(mechanism, dial, direction, possible);
      if (!to) continue;
      const double distance = std::abs(*to - dial.value) / dial.scale;
      if (!nearest || distance < nearest->distance) {
        nearest = Ranked{{dial.key, dial.value, *to, dial.unit, change_text(dial, *to)}, distance};
      }
    }
    if (nearest) found.push_back(*nearest);
  }
  std::stable_sort(found.begin(), found.end(), [](const Ranked& a, const Ranked& b) { return a.distance < b.distance; });
  std::vector<Change> changes;
  for (const Ranked& ranked : found) changes.push_back(ranked.change);
  return changes;
}

std::string advice_sentence(const std::vector<Change>& changes) {
  std::string sentence;
  for (const Change& change : changes) sentence += (sentence.empty() ? "make " : ", or ") + change.text;
  return sentence;
}

}  // namespace fusee
