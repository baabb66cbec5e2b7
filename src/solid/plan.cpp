#include "solid/plan.h"

#include <algorithm>

#include "solid/bore.h"
#include "solid/set_screw.h"

namespace fusee {

bool BodyPlan::possible() const {
  return std::all_of(conditions.begin(), conditions.end(), [](const Condition& condition) { return condition.ok; });
}

BodyPlan plan_body(const Mechanism& mechanism, const SynthesisResult& synthesis) {
  BodyPlan plan;
  plan.layout = axial_layout(mechanism);
  const double diameter = mechanism.body.bore_diameter > 0 ? mechanism.body.bore_diameter : 5.0;
  plan.layout.bore = bore_layout(mechanism.body, diameter, mechanism.material.hole_compensation);
  plan.rims = flange_rims(synthesis.p1, synthesis.p2, mechanism.tendon.diameter, plan.layout.groove_depth,
                          mechanism.body.flange);
  return plan;
}

}  // namespace fusee
