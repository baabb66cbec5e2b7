#include "fusee/solid/layout.h"

#include <cmath>
#include <numeric>

#include "fusee/base/units.h"
#include "solid/plan.h"

namespace fusee {

RoundHole circle_within(const Polygon& facets) {
  const Vec2 centre = std::accumulate(facets.begin(), facets.end(), Vec2(0, 0)) / static_cast<double>(facets.size());
  return {centre, 2.0 * distance_to_edges(facets, centre)};
}

double rise_of(const BodyLayout& layout, double width) {
  return width * std::tan(layout.roof_slope > 0 ? layout.roof_slope : radians(45));
}

BodyLayout resolve_layout(const Mechanism& mechanism, const SynthesisResult& synthesis) {
  return plan_body(mechanism, synthesis).layout;
}

}  // namespace fusee
