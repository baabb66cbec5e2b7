#include "solid/support_attribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "solid/overhangs.h"
#include "solid/place.h"
#include "solid/plane_distance.h"
#include "solid/print.h"

namespace fusee::solid {
namespace {

// A channel entry extends beyond its bars by about this many groove depths and channel widths.
constexpr double k_entry_depths = 2.0;
constexpr double k_entry_widths = 2.0;
// Pocket radii by which a tail's slot counts as nearer. At the pocket, which also belongs to the tie-off, a place is
// then attributed to the slot.
constexpr double k_slot_preference = 0.1;

// The nearest feature to a place.
struct Attribution {
  double gap = std::numeric_limits<double>::infinity();
  std::optional<Rejection> rejection;

  void consider(double candidate_gap, const Rejection& candidate) {
    if (candidate_gap >= gap) return;
    gap = candidate_gap;
    rejection = candidate;
  }
};

// P1's tie-offs lie below the parting plane, P2's above.
Attribution attribution_of(const Vec3& place, const BodyPlan& plan) {
  const BodyLayout& layout = plan.layout;
  const transmission::Side side = place.z() < layout.z_mate ? transmission::Side::left : transmission::Side::right;
  const Bar at{place.head<2>(), place.head<2>(), 0.0};
  Attribution nearest;
  for (const PlannedAnchor& anchor : plan.anchors) {
    if (anchor.side != side) continue;
    const Rejection itself{side, anchor.wound_end, anchor.wrap(), false};
    for (const Bar& bar : anchor.bars(layout)) nearest.consider(gap(at, bar), itself);
    if (anchor.tail) {
      nearest.consider(gap(at, {anchor.tail->from, anchor.tail->to, 0.5 * anchor.tail->width}) -
                           anchor.pocket_radius(layout) * k_slot_preference,
                       {side, anchor.wound_end, anchor.wrap(), true});
    }
  }
  return nearest;
}

}  // namespace

std::vector<Vec3> unprintable_places(const TriangleMesh& mesh, Piece piece, const BodyLayout& layout, double overhang,
                                     Corners corners) {
  std::vector<Vec3> places = ledges_in_layers(mesh, overhang, corners);
  const std::vector<Vec3> regions = find_unsupported_regions(mesh, PrintLimits{}.first_layer);
  places.insert(places.end(), regions.begin(), regions.end());
  for (Vec3& place : places) {
    if (piece == Piece::p1) place.tail<2>() = -place.tail<2>();
    place /= layout.scale;
    if (piece != Piece::whole) place.z() += layout.z_mate;
  }
  return places;
}

profile::Condition does_not_print(const std::string& name, const std::vector<Vec3>& places,
                                  const std::string& variants) {
  profile::Condition condition;
  condition.name = k_prints;
  condition.ok = false;
  condition.value = static_cast<double>(places.size());
  condition.limit = 0;
  condition.unit = "1";
  condition.message = fmt::format("{} cannot be printed without supports: at {} a layer would overhang too far, {}",
                                  name, place_of(places.front()), variants);
  return condition;
}

std::vector<Rejection> attribute_supports(const std::vector<Vec3>& places, const BodyPlan& plan) {
  const double reach = k_entry_depths * plan.layout.groove_depth + k_entry_widths * plan.layout.channel_width;
  std::vector<Rejection> rejections;
  for (const Vec3& place : places) {
    const Attribution attribution = attribution_of(place, plan);
    if (!attribution.rejection || attribution.gap > reach) continue;
    if (std::find(rejections.begin(), rejections.end(), *attribution.rejection) == rejections.end())
      rejections.push_back(*attribution.rejection);
  }
  return rejections;
}

}  // namespace fusee::solid
