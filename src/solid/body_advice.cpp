#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "fusee/mechanism_file.h"
#include "fusee/solid.h"
#include "mechanism/catalogue.h"
#include "solid/plan.h"
#include "solid/size.h"

namespace fusee::solid {
namespace {

// Numbers of the body that advice may change.
constexpr std::array k_body_keys{"body.groove_depth_mm", "body.flange_thickness_mm", "body.hub_diameter_mm",
                                 "body.hub_height_mm",   "body.bore_diameter_mm",    "body.bore_flat_mm",
                                 "body.anchor_hole_mm",  "body.knot_pocket_mm",      "body.min_wall_mm",
                                 "body.wrap_deg"};
// Numbers of a custom horn. None of them may be automatic, and 0 has no special meaning.
constexpr std::array k_horn_keys{"horn.bolt_circle_mm",   "horn.bolt_hole_mm",   "horn.centre_hole_mm",
                                 "horn.boss_diameter_mm", "horn.boss_height_mm", "horn.spline_length_mm"};

double number_of(const Mechanism& mechanism, const std::string& key) {
  return fusee::number_of(mechanism, *find_field(key));
}

std::vector<std::string> written_keys(const Mechanism& mechanism) {
  std::vector<std::string> keys;
  const auto counts = [&](std::string_view key) { return is_written(mechanism, key); };
  std::copy_if(k_body_keys.begin(), k_body_keys.end(), std::back_inserter(keys), counts);
  if (mechanism.body.bore == Bore::horn && mechanism.body.horn == k_own_horn)
    std::copy_if(k_horn_keys.begin(), k_horn_keys.end(), std::back_inserter(keys), counts);
  return keys;
}

/// Alternative values of a key that is not a number, in the order in which they are tried.
struct Alternatives {
  const char* condition;  ///< prefix of the conditions that they may satisfy
  const char* key;
  std::vector<std::string_view> values;
};
const std::vector<Alternatives>& screw_alternatives(bool with_inch_screw) {
  static const std::vector<Alternatives> metric{
      {"set_screw", "body.set_screw", {"M5", "M4", "M3", "M2.5", "M2", "none"}},
      {"clamp_screw", "body.clamp_screw", {"M2.5", "M2", "none"}},
      {"clamp_screw", "print.parts", {"two"}}};
  static const std::vector<Alternatives> inch{
      {"set_screw", "body.set_screw", {"#10-24", "#8-32", "#6-32", "#4-40", "#2-56", "none"}},
      {"clamp_screw", "body.clamp_screw", {"#2-56", "none"}},
      {"clamp_screw", "print.parts", {"two"}}};
  return with_inch_screw ? inch : metric;
}
/// Alternatives if every condition holds but the finished part is not printable.
const std::vector<Alternatives>& printing_alternatives() {
  static const std::vector<Alternatives> all{{"", "print.parts", {"two", "one"}}, {"", "print.supports", {"true"}}};
  return all;
}

/// The value of print.parts in a file; empty for automatic.
std::string_view parts_word(Parts parts) {
  if (parts == Parts::one) return "one";
  return parts == Parts::two ? "two" : "";
}

class BodyAdviser {
 public:
  BodyAdviser(const Mechanism& mechanism, const profile::FeasibilityOracle& judge, Parts refused)
      : mechanism_(mechanism), judge_(judge), refused_(parts_word(refused)) {}

  profile::Advice all() const {
    profile::Advice advice;
    const std::vector<profile::Condition> failed = judge_.obstacles(mechanism_);
    if (failed.empty()) {
      for (const Alternatives& alternatives : printing_alternatives()) add_alternative(advice.alone, alternatives);
      return advice;
    }
    for (const Alternatives& alternatives : screw_alternatives(has_inch_screw())) {
      const auto is_about = [&alternatives](const profile::Condition& condition) {
        return condition.name.starts_with(alternatives.condition);
      };
      if (std::any_of(failed.begin(), failed.end(), is_about)) add_alternative(advice.alone, alternatives);
    }
    // If the curves themselves are impossible, no number of the body helps.
    profile::FeasibilityOracle judge = judge_;
    judge.is_expensive = !profile::obstacle_to(mechanism_);  // each try plans a body
    std::vector<std::string> keys = judge.is_expensive ? written_keys(mechanism_) : std::vector<std::string>{};
    // The cones are as steep as the overhang angle, so a smaller angle makes the part lower.
    const auto is_height = [](const profile::Condition& condition) { return condition.name == k_height_condition; };
    if (!mechanism_.print.supports && std::any_of(failed.begin(), failed.end(), is_height))
      keys.emplace_back("print.overhang_deg");
    const profile::Advice numbers = profile::find_advice(mechanism_, judge, keys, advice.alone.size());
    advice.alone.insert(advice.alone.end(), numbers.alone.begin(), numbers.alone.end());
    advice.is_exhausted = numbers.is_exhausted;
    for (const std::string& key : keys) {
      if (advice.alone.empty() && key.starts_with("body.")) add_automatic(advice.alone, key);
    }
    if (advice.alone.empty()) advice.together = numbers.together;
    return advice;
  }

 private:
  bool helps(const Mechanism& changed) const {
    if (!judge_.obstacles(changed).empty()) return false;
    return !judge_.made || ((!judge_.builds_left || judge_.builds_left() > 0) && judge_.made(changed));
  }

  /// True if a screw of the file is an inch screw: its alternatives are of the same kind.
  bool has_inch_screw() const {
    const auto is_inch = [](const std::string& screw) { return screw.find('-') != std::string::npos; };
    return is_inch(mechanism_.body.set_screw) || is_inch(mechanism_.body.clamp_screw);
  }

  // Adds the first alternative that helps. The list is ordered, so those before the present value are not tried.
  void add_alternative(std::vector<profile::Change>& changes, const Alternatives& alternatives) const {
    const std::vector<std::string_view>& values = alternatives.values;
    const Field& field = *find_field(alternatives.key);
    DeclaredMechanism changed(mechanism_);
    const std::string present = field.get_text(changed);
    const auto found = std::find(values.begin(), values.end(), present);
    for (auto value = found == values.end() ? values.begin() : found + 1; value != values.end(); ++value) {
      field.set_text(changed, *value);
      if (*value == present || *value == refused_ || !helps(changed)) continue;
      const char* quote = field.kind == FieldKind::boolean ? "" : "\"";
      changes.push_back({alternatives.key,
                         0,
                         0,
                         {},
                         fmt::format("{} = {}{}{}", alternatives.key, quote, *value, quote),
                         present,
                         std::string(*value)});
      return;
    }
  }

  // If no other value of a number helps, it may still be left automatic.
  void add_automatic(std::vector<profile::Change>& changes, const std::string& key) const {
    Mechanism automatic = mechanism_;
    const Field& field = *find_field(key);
    set_number(automatic, field, 0, 0.0);
    if (field.least <= 0 && helps(automatic))
      changes.push_back({key, number_of(mechanism_, key), 0.0, std::string(field.unit), key + " = 0 (automatic)"});
  }

  const Mechanism& mechanism_;
  const profile::FeasibilityOracle& judge_;
  std::string_view refused_;  ///< a value of print.parts; empty: none
};

}  // namespace

bool is_written(const Mechanism& mechanism, std::string_view key) {
  // A value given by a shaft is not changed alone: the file would contradict itself.
  if (key.starts_with("body.bore_") && find_shaft(mechanism.body.shaft) != nullptr) return false;
  if (key == "body.bore_flat_mm" && mechanism.body.bore != Bore::d) return false;
  return number_of(mechanism, std::string(key)) > 0;
}

std::vector<profile::Condition> body_obstacles(const Mechanism& mechanism, const profile::SynthesisResult& synthesis) {
  return profile::failed_of(
      plan_body(mechanism, synthesis, {.wrap = WrapChoice::nearest, .conditions_alone = true}).conditions);
}

std::vector<profile::Condition> obstacles(const Mechanism& mechanism) {
  const profile::SynthesisResult synthesis = profile::synthesise(mechanism, {.advice = false});
  return synthesis.made() ? body_obstacles(mechanism, synthesis) : profile::failed_of(synthesis.conditions);
}

profile::Advice body_advice(const Mechanism& mechanism, const profile::FeasibilityOracle& judge, Parts refused) {
  return BodyAdviser(mechanism, judge, refused).all();
}

}  // namespace fusee::solid
