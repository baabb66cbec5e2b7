#include <algorithm>
#include <array>
#include <iterator>

#include "fusee/mechanism/catalogue.h"
#include "fusee/base/diagnostics.h"
#include "fusee/mechanism/fields.h"
#include "fusee/solid/pulley.h"
#include "solid/plan.h"

namespace fusee {
namespace {

constexpr std::array k_body_keys{"body.groove_depth_mm", "body.flange_thickness_mm", "body.hub_diameter_mm",
                                 "body.hub_height_mm",   "body.bore_diameter_mm",    "body.anchor_hole_mm",
                                 "body.knot_pocket_mm",  "body.min_wall_mm",         "body.wrap_deg"};
// Of a horn of one's own; 0 is none of these and never "automatic".
constexpr std::array k_horn_keys{"horn.bolt_circle_mm",   "horn.bolt_hole_mm",   "horn.centre_hole_mm",
                                 "horn.boss_diameter_mm", "horn.boss_height_mm", "horn.spline_length_mm"};

double number_of(const Mechanism& mechanism, const std::string& key) {
  return fusee::number_of(mechanism, *find_field(key));
}

// Numbers that were written: a change of what is automatic would be no advice, and 0 is not a small number but
// "automatic".
std::vector<std::string> written_keys(const Mechanism& mechanism) {
  std::vector<std::string> keys;
  const auto is_written = [&mechanism](const std::string& key) { return number_of(mechanism, key) > 0; };
  std::copy_if(k_body_keys.begin(), k_body_keys.end(), std::back_inserter(keys), is_written);
  if (mechanism.body.bore == Bore::horn && mechanism.body.horn == k_own_horn)
    std::copy_if(k_horn_keys.begin(), k_horn_keys.end(), std::back_inserter(keys), is_written);
  return keys;
}

// A number for which no other value was found may still be left to the program.
void add_automatic(std::vector<Change>& changes, const Mechanism& mechanism, const std::string& key) {
  const auto is_it = [&key](const Change& change) { return change.key == key; };
  if (std::any_of(changes.begin(), changes.end(), is_it)) return;
  Mechanism automatic = mechanism;
  const Field& field = *find_field(key);
  set_number(automatic, field, 0, 0.0);
  if (body_possible(automatic))
    changes.push_back({key, number_of(mechanism, key), 0.0, std::string(field.unit), key + " = 0 (automatic)"});
}

}  // namespace

// What is tried may be so odd that no rim can be drawn about it: that is no advice, and no bug of the design at hand.
bool body_possible(const Mechanism& mechanism) {
  const SynthesisResult synthesis = synthesise(mechanism, {.advice = false});
  if (!synthesis.made()) return false;
  // The nearest tie-offs decide; how much further round they may go takes a search of its own.
  Mechanism nearest = mechanism;
  if (nearest.body.wrap <= 0) nearest.body.wrap = 1e-9;
  try {
    return plan_body(nearest, synthesis).possible();
  } catch (const Bug&) {
    return false;
  }
}

std::vector<Change> body_advice(const Mechanism& mechanism) {
  // What only does not print says what helps; it was tried.
  if (body_possible(mechanism)) return {{"print.supports", 0, 1, "", "print.supports = true"}};
  const std::vector<std::string> keys = written_keys(mechanism);
  const auto possible = [&keys](const Mechanism& changed) {
    return written_keys(changed).size() == keys.size() && body_possible(changed);
  };
  std::vector<Change> changes = nearest_changes(mechanism, possible, keys);
  for (const std::string& key : keys) {
    if (key.starts_with("body.")) add_automatic(changes, mechanism, key);
  }
  return changes;
}

}  // namespace fusee
