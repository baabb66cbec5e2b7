#include "fusee/solid/pulley.h"

#include <fmt/format.h>

#include <optional>

#include "fusee/base/diagnostics.h"
#include "solid/boolean.h"
#include "solid/gate.h"
#include "solid/marks.h"
#include "solid/plan.h"
#include "solid/rings.h"
#include "solid/tie_off_tools.h"
#include "solid/tools.h"

namespace fusee {
namespace {

// Tools stand out of the body by this, so that no two of their faces coincide.
constexpr double k_overshoot = 1.0;
// A cut whose rounding to float left a fault is tried again with other facets on the tools.
constexpr int k_variants = 8;

// A body with its features, and what it must measure.
struct Featured {
  TriangleMesh mesh;
  double volume = 0;
};

class FeatureCutter {
 public:
  FeatureCutter(const Mechanism& mechanism, const BodyPlan& plan, const std::vector<Mark>& marks)
      : mechanism_(mechanism), plan_(plan), layout_(plan.layout), marks_(marks) {}

  // Null when the result is no solid: the next variant may do better.
  std::optional<Featured> cut(const TriangleMesh& body, double volume, int variant) const {
    Featured result{body, volume};
    if (const TriangleMesh tool = placed(cuts(variant)); !tool.triangles.empty()) {
      const auto outcome = subtract(result.mesh, tool);
      if (!outcome) return std::nullopt;
      result = {outcome->mesh, result.volume - outcome->common_volume};
    }
    if (const TriangleMesh raised = placed(raised_marks()); !raised.triangles.empty()) {
      const double added = enclosed_volume(raised);
      const auto outcome = unite(result.mesh, raised);
      if (!outcome) return std::nullopt;
      result = {outcome->mesh, result.volume + added - outcome->common_volume};
    }
    if (!all_ok(check_mesh(result.mesh))) return std::nullopt;
    return result;
  }

 private:
  // From the layout's mm to the mesh's floats.
  TriangleMesh placed(const std::vector<TriangleMesh>& tools) const {
    TriangleMesh all = together(tools);
    for (Vec3& vertex : all.vertices) vertex *= layout_.scale;
    return rounded_to_float(std::move(all));
  }

  std::vector<TriangleMesh> cuts(int variant) const {
    std::vector<TriangleMesh> tools;
    for (const PlannedAnchor& anchor : plan_.anchors) tools.push_back(tie_off_tool(plan_, anchor, variant));
    if (layout_.set_screw.present)
      tools.push_back(set_screw_tool(layout_.set_screw, layout_.hub_radius, layout_.z_hub, variant));
    const double depth = layout_.mark_depth;
    for (const Mark& mark : marks_) {
      if (!mark.on_top) tools.push_back(prism(mark.loops, -k_overshoot, depth));
      if (mark.on_top && mechanism_.body.marks == Marks::engraved)
        tools.push_back(prism(mark.loops, layout_.z_top - depth, layout_.z_top + k_overshoot));
    }
    return tools;
  }

  std::vector<TriangleMesh> raised_marks() const {
    std::vector<TriangleMesh> raised;
    if (mechanism_.body.marks != Marks::raised) return raised;
    for (const Mark& mark : marks_) {
      if (mark.on_top)
        raised.push_back(
            prism(mark.loops, layout_.z_top - 0.5 * layout_.flange_thickness, layout_.z_top + layout_.mark_depth));
    }
    return raised;
  }

  const Mechanism& mechanism_;
  const BodyPlan& plan_;
  const BodyLayout& layout_;
  const std::vector<Mark>& marks_;
};

// Every way through the body is a handle. The bore's holes, one tunnel for each tie-off, and for the set screw a branch
// from the bore to the hub's side and, with a nut trap, another to its top.
int handles(const RingStack& stack, const BodyPlan& plan) {
  const int screw = plan.layout.set_screw.present ? (plan.layout.set_screw.nut_trap ? 2 : 1) : 0;
  return static_cast<int>(stack.through.size() + plan.anchors.size()) + screw;
}

std::vector<Anchor> anchors_of(const BodyPlan& plan) {
  std::vector<Anchor> anchors;
  for (const PlannedAnchor& planned : plan.anchors) {
    const BodyLayout& layout = plan.layout;
    const Keyhole shape =
        keyhole(planned.path, layout.channel_width, layout.pocket_radius, pocket_facets(layout.pocket_radius));
    anchors.push_back({planned.side, planned.wound_end, planned.path.start, outline_of(shape), planned.path.pocket()});
  }
  return anchors;
}

}  // namespace

std::string Pulley::brief() const {
  if (made()) {
    return fmt::format("a body of {} facets, {:.1f} cm³, {} tie-offs", mesh.triangles.size(), expected_volume / 1000.0,
                       anchors.size());
  }
  std::string text = "no such body can be made";
  for (const Condition& condition : conditions) {
    if (!condition.ok) text += "; " + condition.message;
  }
  if (!advice.empty()) text += "; " + advice_sentence(advice);
  return text;
}

Pulley make_pulley(const Mechanism& mechanism, const SynthesisResult& synthesis) {
  demand(synthesis.made(), "a body of an infeasible profile");
  BodyPlan plan = plan_body(mechanism, synthesis);
  Pulley pulley;
  pulley.conditions = plan.conditions;
  pulley.layout = plan.layout;
  if (!plan.possible()) return pulley;
  const std::vector<Mark> marks = marks_of(mechanism.body.marks, plan);
  pulley.layout = plan.layout;
  pulley.anchors = anchors_of(plan);
  const RingStack stack = scaled_to_float(
      body_stack(synthesis.p1, synthesis.p2, mechanism.tendon.diameter, mechanism.body.flange, plan.layout),
      plan.layout.scale);
  const TriangleMesh body = mesh_of(stack);
  demand_solid(body, "body");
  const FeatureCutter cutter(mechanism, plan, marks);
  std::optional<Featured> featured;
  for (int variant = 0; variant < k_variants && !featured; ++variant)
    featured = cutter.cut(body, volume_of(stack), variant);
  demand(featured.has_value(), "the features cannot be cut into the body of " + mechanism.name);
  pulley.mesh = std::move(featured->mesh);
  pulley.expected_volume = featured->volume;
  pulley.expected_euler = 2 - 2 * handles(stack, plan);
  pulley.status = PulleyStatus::made;
  return pulley;
}

}  // namespace fusee
