// The fit coupon: a flat part with every fit of a kit in five steps.

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/kit.h"
#include "kit/parts.h"

namespace fusee::kit {
namespace {

// All sizes in mm.
constexpr int k_steps = 5;
constexpr double k_step = 0.1;  // from one fit to the next
constexpr double k_pitch = 14;  // distance of neighbouring columns
constexpr double k_length = 80, k_width = 52, k_height = 4;
constexpr double k_peg = 3;             // radius
constexpr double k_number_depth = 0.6;  // of engraving

// The x of the column of a step.
double column(int step) { return 12 + step * k_pitch; }

/// Shaft diameter of the holes: the mechanism's, or a default.
double tried_shaft(const Mechanism& mechanism) {
  const double shaft = mechanism.body.bore_diameter > 0 ? mechanism.body.bore_diameter : 5;
  return std::clamp(shaft, 2.0, 8.0);
}
/// Tendon diameter of the slots.
double tried_tendon(const Mechanism& mechanism) { return std::clamp(mechanism.tendon.diameter, 0.5, 5.0); }

}  // namespace

SlabBody coupon_body(const Mechanism& mechanism) {
  const SlabLoop rim{box({0, 0}, {k_length, k_width}, 2), false, 0, 0};
  std::vector<SlabLoop> through;
  const auto cut = [&through](DiscHull hull) { through.push_back({std::move(hull), true, 0, 0}); };
  for (int i = 0; i < k_steps; ++i) {
    const double x = column(i), more = i * k_step;
    // Holes for the shaft, grooves for the tendon, and pegs in holes. The first hole for the shaft is nominal; the
    // first groove and the first hole of a peg have a clearance of one step.
    cut(disc({x, 42}, 0.5 * (tried_shaft(mechanism) + more)));
    cut(slot({x, 22}, {x, 31}, 0.5 * (tried_tendon(mechanism) + more + k_step)));
    cut(disc({x, 11}, k_peg + more + k_step));
    through.push_back({disc({x, 11}, k_peg), false, 0, 0});
  }
  Slab lower{0, k_height - k_number_depth, {rim}}, upper{k_height - k_number_depth, k_height, {rim}};
  for (Slab* slab : {&lower, &upper}) slab->loops.insert(slab->loops.end(), through.begin(), through.end());
  for (int i = 0; i < k_steps; ++i) {
    for (DiscHull& stroke : number_strokes(i, {column(i) + 6.5, 3.2}, {0, 1}))
      upper.loops.push_back({std::move(stroke), true, 0, 0});
  }
  return {{lower, upper}};
}

std::vector<CouponReading> coupon_readings(const Mechanism& mechanism) {
  const std::string shaft = rounded(tried_shaft(mechanism)), tendon = rounded(tried_tendon(mechanism));
  // Pages of an inch file convert numbers that have the unit mm.
  const std::string mm = mechanism.units == LengthUnit::inch ? " mm" : "";
  return {
      {"upper row: holes of " + shaft + " mm and 0.1 mm more each",
       "the number of the first hole that a shaft of " + shaft + " mm enters by hand",
       "material.hole_compensation_mm = 0.1" + mm + " × that number"},
      {"middle row: grooves of " + rounded(tried_tendon(mechanism) + k_step) + " mm and 0.1 mm more each",
       "the number of the first groove that the tendon (" + tendon + " mm) runs through freely",
       "body.anchor_hole_mm = " + rounded(tried_tendon(mechanism) + k_step) + mm + " + 0.1" + mm + " × that number"},
      {"lower row: pegs in their holes, 0.1 mm of clearance and 0.1 mm more each",
       "the number of the first peg that turns when pushed",
       std::string(
           "above 3: the printer squeezes too much. Lower its flow first; then material.hole_compensation_mm 0.1") +
           mm + " larger"},
      {"its length, across the middle of its height",
       "measured with a caliper: " + rounded(k_length) + " mm is nominal",
       "material.shrinkage_percent = 100 × (1 − measured / " + rounded(k_length) + mm + ")"},
      {"its width at the bed and at its upper face", "both, with a caliper",
       "material.elephant_foot_mm = half of the additional width at the bed"}};
}

}  // namespace fusee::kit
