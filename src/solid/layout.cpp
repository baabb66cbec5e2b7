#include <algorithm>
#include <cmath>
#include <numeric>

#include "fusee/base.h"
#include "fusee/solid.h"
#include "solid/plan.h"

namespace fusee::solid {

RoundHole circle_within(const Polygon& facets) {
  const Vec2 centre = std::accumulate(facets.begin(), facets.end(), Vec2(0, 0)) / static_cast<double>(facets.size());
  return {centre, 2.0 * distance_to_edges(facets, centre)};
}

void BodyLayout::omit(std::string feature, std::string note) {
  omissions.push_back({std::move(feature), notes.size()});
  notes.push_back(std::move(note));
}

bool BodyLayout::lacks(std::string_view feature) const {
  return std::any_of(omissions.begin(), omissions.end(),
                     [feature](const Omission& omission) { return omission.feature == feature; });
}

double rise_of(const BodyLayout& layout, double width) {
  return width * elementary::tan(layout.ceiling_slope > 0 ? layout.ceiling_slope : radians(45));
}

// Slicers close a slit when less than 0.1 mm of it remains (PrusaSlicer's gap closing radius is 0.049 mm). The closing
// layer then projects by that much more. At 45° and layers of 0.2 mm, 54.2° is sufficient.
double ridge_slope(const BodyLayout& layout) {
  constexpr double k_steeper = radians(10), k_steepest = radians(80);
  return layout.ceiling_slope > 0 ? std::min(layout.ceiling_slope + k_steeper, k_steepest) : radians(45);
}

BodyLayout resolve_layout(const Mechanism& mechanism, const profile::SynthesisResult& synthesis) {
  return plan_body(mechanism, synthesis).layout;
}

}  // namespace fusee::solid
