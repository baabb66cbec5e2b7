#include "solid/tails.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"
#include "solid/bore.h"
#include "solid/plane_distance.h"
#include "solid/set_screw.h"
#include "solid/tie_off_tools.h"

namespace fusee::solid {
namespace {

// Depth of a slot in tendon diameters, so that the tail lies below the face.
constexpr double k_depth_ratio = 1.2;
// Least depth of the walls below a peaked ceiling, in tendon diameters.
constexpr double k_peaked_ratio = 0.8;
// Length of a slot beyond the pocket's edge in tendon diameters. The slot is as long as space permits, up to a thumb's
// width. The shortest is what glue requires.
constexpr double k_longest_ratio = 10.0;
constexpr double k_shortest_ratio = 3.0;
// Material below a slot's floor and above a channel's ceiling: two layers.
constexpr double k_ground_of_slot = 0.4;
// Number of directions of a slot that are tried.
constexpr int k_slot_directions = 72;
// Length of thread for a screw in plastic, in nominal diameters: preferred and least.
constexpr double k_thread_ratio = 2.5;
constexpr double k_least_thread_ratio = 1.5;

class TailPlacer {
 public:
  TailPlacer(const BodyPlan& plan, const Mechanism& mechanism)
      : plan_(plan),
        layout_(plan.layout),
        d_(mechanism.tendon.diameter),
        compensation_(mechanism.material.hole_compensation),
        screw_(find_screw(mechanism.body.clamp_screw)),
        floor1_(plan.floor1),
        floor2_(plan.floor2) {}

  std::optional<TailSlot> place(const PlannedAnchor& anchor) const {
    TailSlot slot;
    slot.width = layout_.channel_width;
    const bool peaked = is_pocket_face_on_bed(layout_, anchor.side);
    slot.ceiling = peaked ? 0.5 * slot.width * elementary::tan(ridge_slope(layout_)) : 0.0;
    slot.depth = std::max(k_peaked_ratio * d_, k_depth_ratio * d_ - slot.ceiling);
    const double deep = slot.depth + slot.ceiling;
    // Clearances are computed above the groove's plane. A slot as deep as that plane is not planned.
    if (to_plane(anchor.side) - deep < k_ground_of_slot) return std::nullopt;
    // A slot that is deep enough to meet channels must keep clear of them in plan.
    const bool over_channels = to_channels(anchor.side) - deep >= k_ground_of_slot;
    if (screw_ != nullptr && !add_screw(slot, anchor.side)) return std::nullopt;
    slot.from = anchor.pocket();
    const double edge = anchor.pocket_radius(layout_);
    std::vector<Bar> at_face = obstacles_at_face(anchor);
    if (!over_channels) add_channels_beside(anchor, at_face);
    std::optional<TailSlot> best;
    double longest = edge + k_shortest_ratio * d_ - 0.5 * d_;
    // Starts with the channel's direction and alternates to both sides.
    const Vec2 ahead = heading(anchor);
    for (int k = 0; k < k_slot_directions; ++k) {
      const double turn = (k % 2 == 0 ? 1.0 : -1.0) * k_two_pi / k_slot_directions * ((k + 1) / 2);
      const Vec2 direction = turned(ahead, turn);
      // The tie-off's own channel comes from behind, where a deep slot would meet it.
      const bool clears_own_channel =
          direction.dot(ahead) >= 0 || edge * std::abs(cross(direction, ahead)) >= slot.width;
      if (!over_channels && !clears_own_channel) continue;
      for (double length = edge + k_longest_ratio * d_; length > longest; length -= 0.5 * d_) {
        slot.to = slot.from + length * direction;
        if (!is_free(slot, anchor.side, at_face)) continue;
        longest = length;
        best = slot;
        break;
      }
    }
    return best;
  }

 private:
  // Distance from the face to the groove's plane.
  double to_plane(transmission::Side side) const {
    return side == transmission::Side::left ? layout_.z_p1 : layout_.z_top - layout_.z_p2;
  }
  // Distance from the face to the nearest point of a channel, whose ceiling rises in printing direction.
  double to_channels(transmission::Side side) const {
    return to_plane(side) - 0.5 * layout_.channel_width -
           (is_pocket_face_on_bed(layout_, side) ? 0.0 : layout_.channel_ceiling);
  }

  void add_channels_beside(const PlannedAnchor& own, std::vector<Bar>& bars) const {
    for (const PlannedAnchor& anchor : plan_.anchors) {
      if (&anchor == &own || anchor.side != own.side) continue;
      const std::vector<Bar> tie_off = anchor.bars(layout_);
      bars.insert(bars.end(), tie_off.begin(), tie_off.end());
    }
  }

  // Makes the thread as long as the material under the slot permits; false if the thread would be too short.
  bool add_screw(TailSlot& slot, transmission::Side side) const {
    double material = layout_.z_top;
    if (layout_.parts != Parts::one)
      material = side == transmission::Side::left ? layout_.z_mate : layout_.z_top - layout_.z_mate;
    const double below = slot.depth + slot.ceiling, room = material - k_ground_of_slot - below;
    slot.pilot_diameter = screw_->tapping + compensation_;
    slot.pilot_depth = below + std::min(k_thread_ratio * screw_->nominal, room);
    slot.head_diameter = screw_->head;
    return room >= k_least_thread_ratio * screw_->nominal;
  }

  static Vec2 heading(const PlannedAnchor& anchor) {
    if (const auto* path = std::get_if<AnchorPath>(&anchor.tie_off)) return path->heading();
    return -std::get<FaceHole>(anchor.tie_off).normal;
  }

  std::vector<Bar> obstacles_at_face(const PlannedAnchor& own) const {
    const bool left = own.side == transmission::Side::left;
    std::vector<Bar> bars{
        {Vec2::Zero(), Vec2::Zero(), left ? layout_.bore.radius : std::max(layout_.bore.radius, layout_.hub_radius)}};
    add_holes(bars);
    for (const PlannedAnchor& anchor : plan_.anchors) {
      if (&anchor == &own || anchor.side != own.side) continue;
      bars.push_back({anchor.pocket(), anchor.pocket(), anchor.pocket_radius(layout_)});
      if (anchor.tail) bars.push_back({anchor.tail->from, anchor.tail->to, 0.5 * anchor.tail->head_or_width()});
    }
    return bars;
  }

  void add_holes(std::vector<Bar>& bars) const {
    for (const Polygon& hole : layout_.bore.screw_holes) {
      for (const Vec2& corner : hole) bars.push_back({corner, corner, 0.0});
    }
    for (const Vec2& place : layout_.dowels.places) bars.push_back({place, place, 0.5 * layout_.dowels.hole_diameter});
  }

  bool is_free(const TailSlot& slot, transmission::Side side, const std::vector<Bar>& at_face) const {
    const double half = 0.5 * slot.width, wall = layout_.min_wall;
    const ConvexSides& floor = side == transmission::Side::left ? floor1_ : floor2_;
    if (floor.depth_of(slot.to) < half + wall) return false;
    const auto clear = [&](const Bar& bar) {
      return std::all_of(at_face.begin(), at_face.end(), [&](const Bar& other) { return gap(bar, other) >= wall; });
    };
    if (!clear({slot.from, slot.to, half})) return false;
    return slot.pilot_diameter <= 0 ||
           (clear({slot.to, slot.to, 0.5 * slot.head_diameter}) && has_space_for_pilot(slot));
  }

  // The pilot hole is deep: it must clear all features of both pulleys.
  bool has_space_for_pilot(const TailSlot& slot) const {
    const double radius = circumradius(polyhole(slot.pilot_diameter, Vec2::Zero())), wall = layout_.min_wall;
    if (std::min(floor1_.depth_of(slot.to), floor2_.depth_of(slot.to)) < radius + wall) return false;
    std::vector<Bar> bars{{Vec2::Zero(), Vec2::Zero(), layout_.bore.radius}};
    add_holes(bars);
    for (const PlannedAnchor& anchor : plan_.anchors) {
      const std::vector<Bar> tie_off = anchor.bars(layout_);
      bars.insert(bars.end(), tie_off.begin(), tie_off.end());
    }
    return std::all_of(bars.begin(), bars.end(), [&](const Bar& bar) {
      return gap({slot.to, slot.to, radius}, bar) >= wall;
    });
  }

  const BodyPlan& plan_;
  const BodyLayout& layout_;
  double d_;  ///< diameter of the tendon
  double compensation_;
  const Screw* screw_;
  ConvexSides floor1_, floor2_;
};

profile::Condition clamp_condition(const std::string& screw, transmission::Side side, bool placed) {
  profile::Condition condition;
  condition.name = fmt::format("clamp_screw_{}", transmission::pulley_name(side));
  condition.ok = placed;
  condition.value = placed ? 1 : 0;
  condition.limit = 1;
  condition.unit = "1";
  condition.message = fmt::format("{} has no space for clamp screw {} (body.clamp_screw) at the end of a tail's slot",
                                  transmission::pulley_name(side), screw);
  return condition;
}

}  // namespace

std::vector<profile::Condition> place_tails(BodyPlan& plan, const Mechanism& mechanism,
                                            const std::vector<Rejection>& rejected) {
  const std::string& screw = mechanism.body.clamp_screw;
  const bool clamps = find_screw(screw) != nullptr;
  std::vector<profile::Condition> conditions;
  if (mechanism.body.tail == Tail::none && !clamps) return conditions;
  const TailPlacer placer(plan, mechanism);
  for (PlannedAnchor& anchor : plan.anchors) {
    if (!anchor.wound_end) continue;
    if (std::find(rejected.begin(), rejected.end(), Rejection{anchor.side, true, anchor.wrap(), true}) ==
        rejected.end())
      anchor.tail = placer.place(anchor);
    if (clamps) conditions.push_back(clamp_condition(screw, anchor.side, anchor.tail.has_value()));
    if (!anchor.tail && !clamps) {
      const std::string_view name = transmission::pulley_name(anchor.side);
      plan.layout.omit(fmt::format("tail_slot_{}", name),
                       fmt::format("no space on {}'s face for a slot for the tendon's tail: omitted", name));
    }
  }
  return conditions;
}

}  // namespace fusee::solid
