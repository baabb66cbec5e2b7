#include "fusee/solid/layout.h"

#include <cmath>

#include "fusee/base/units.h"
#include "solid/plan.h"

namespace fusee {

double rise_of(const BodyLayout& layout, double width) {
  return width * std::tan(layout.roof_slope > 0 ? layout.roof_slope : radians(45));
}

BodyLayout resolve_layout(const Mechanism& mechanism, const SynthesisResult& synthesis) {
  return plan_body(mechanism, synthesis).layout;
}

}  // namespace fusee
