#include "fusee/solid/pulley.h"

#include "fusee/base/text.h"
#include "solid/gate.h"
#include "solid/plan.h"
#include "solid/rings.h"

namespace fusee {

std::string Pulley::brief() const { return {}; }

Pulley make_pulley(const Mechanism& mechanism, const SynthesisResult& synthesis) {
  BodyPlan plan = plan_body(mechanism, synthesis);
  Pulley pulley;
  pulley.layout = plan.layout;
  pulley.conditions = plan.conditions;
  pulley.anchors = plan.anchors;
  if (!plan.possible()) return pulley;
  const RingStack stack = scaled_to_float(
      body_stack(synthesis.p1, synthesis.p2, mechanism.tendon.diameter, mechanism.body.flange, plan.layout),
      plan.layout.scale);
  pulley.mesh = mesh_of(stack);
  demand_solid(pulley.mesh, "body");
  pulley.expected_volume = volume_of(stack);
  pulley.expected_euler = 2 - 2 * static_cast<int>(stack.through.size());
  pulley.status = PulleyStatus::made;
  return pulley;
}

}  // namespace fusee
