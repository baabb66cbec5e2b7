#include "solid/dowels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fusee/base.h"
#include "solid/bore.h"
#include "solid/plane_distance.h"
#include "solid/tools.h"

namespace fusee::solid {
namespace {

// Pin diameters to try, in order of preference.
constexpr std::array<double, 4> k_pins{3.0, 2.5, 2.0, 1.5};
// Least length over which a pin must be held to locate a part.
constexpr double k_least_hold = 1.5;
// Least material between a hole and the face above it.
constexpr double k_least_cover = 0.6;

class DowelChooser {
 public:
  DowelChooser(const Mechanism& mechanism, const BodyPlan& plan)
      : layout_(plan.layout),
        compensation_(mechanism.material.hole_compensation),
        reach_(circumradius(plan.floor1)),
        floor1_(plan.floor1),
        floor2_(plan.floor2) {
    for (auto* bars : {&in_p1_, &in_both_}) {
      bars->push_back({Vec2::Zero(), Vec2::Zero(), layout_.bore.radius});
      for (const Polygon& hole : layout_.bore.screw_holes) {
        for (const Vec2& corner : hole) bars->push_back({corner, corner, 0.0});
      }
    }
    for (const PlannedAnchor& anchor : plan.anchors) {
      const std::vector<Bar> bars = anchor.bars(layout_);
      in_both_.insert(in_both_.end(), bars.begin(), bars.end());
      if (anchor.side == transmission::Side::left) in_p1_.insert(in_p1_.end(), bars.begin(), bars.end());
    }
  }

  DowelLayout choose() const {
    for (const double pin : k_pins) {
      const double ceiling = layout_.ceiling_slope > 0 ? rise_of(layout_, 0.5 * (pin + compensation_)) : 0.0;
      // A deep hole must clear P2's tie-offs as well. A shallow one ends below them.
      const double deep = std::min(layout_.z_p2 + layout_.p2.above_width(), layout_.z_top - k_least_cover - ceiling);
      const double shallow = layout_.z_p2 - 0.5 * layout_.channel_width - layout_.min_wall - ceiling;
      for (const auto& [z_end, obstacles] : {std::pair{deep, &in_both_}, std::pair{shallow, &in_p1_}}) {
        if (z_end - layout_.z_mate < k_least_hold) continue;
        if (const auto places = places_for(pin, *obstacles))
          return {{places->first, places->second}, pin + compensation_, pin, z_end, ceiling};
      }
    }
    return {};
  }

 private:
  std::optional<std::pair<Vec2, Vec2>> places_for(double pin, const std::vector<Bar>& obstacles) const {
    // Radius to the hole's corners.
    const double radius = circumradius(polyhole(pin + compensation_, Vec2::Zero())), room = radius + layout_.min_wall;
    return pin_places(reach_, 2.0 * radius, layout_.min_wall, [&](const Vec2& place) {
      return std::all_of(obstacles.begin(), obstacles.end(),
                         [&](const Bar& bar) {
                           return gap({place, place, room}, bar) >= 0;
                         }) &&
             floor1_.depth_of(place) >= room && floor2_.depth_of(place) >= room;
    });
  }

  const BodyLayout& layout_;
  double compensation_;
  double reach_;
  ConvexSides floor1_, floor2_;
  std::vector<Bar> in_p1_, in_both_;
};

}  // namespace

std::optional<std::pair<Vec2, Vec2>> pin_places(double reach, double diameter, double wall,
                                                const std::function<bool(const Vec2&)>& is_free) {
  constexpr int k_directions = 48;
  constexpr int k_radii = 24;
  // Least angle between two places, seen from the axis. It also excludes opposite places.
  constexpr double k_least_angle = radians(20);
  std::vector<Vec2> free;
  for (int r = 1; r < k_radii; ++r) {
    for (int a = 0; a < k_directions; ++a) {
      const Vec2 place = reach * r / k_radii * unit(k_two_pi * a / k_directions);
      if (is_free(place)) free.push_back(place);
    }
  }
  std::vector<double> from_axis;
  for (const Vec2& place : free) from_axis.push_back(place.norm());
  const double least_sine = elementary::sin(k_least_angle);
  std::optional<std::pair<Vec2, Vec2>> best;
  double widest = diameter + wall;
  for (std::size_t i = 0; i < free.size(); ++i) {
    for (std::size_t j = 0; j < free.size(); ++j) {
      // The first of the pair is the outer one.
      if (from_axis[i] < from_axis[j] + 0.5 * diameter) continue;
      const Vec2 &a = free[i], &b = free[j];
      const double distance = (a - b).norm();
      if (distance <= widest || std::abs(cross(a, b)) < least_sine * from_axis[i] * from_axis[j]) continue;
      widest = distance;
      best = {a, b};
    }
  }
  return best;
}

DowelLayout choose_dowels(const Mechanism& mechanism, const BodyPlan& plan) {
  return DowelChooser(mechanism, plan).choose();
}

// A blind hole ends in a cone. Slicers do not always treat such a small flat ceiling as a bridge.
TriangleMesh dowel_tool(const DowelLayout& dowels, const Vec2& place) {
  constexpr double k_tip = 0.05;  // size of the cone's tip relative to the hole
  const Polygon hole = polyhole(dowels.hole_diameter, Vec2::Zero());
  const auto ring = [&](double share, double z) {
    Polygon outline;
    for (const Vec2& corner : hole) outline.emplace_back(place + share * corner);
    return at_height(outline, z);
  };
  if (dowels.ceiling <= 0) return strip({ring(1, -k_overshoot), ring(1, dowels.z_end)});
  return strip({ring(1, -k_overshoot), ring(1, dowels.z_end), ring(k_tip, dowels.z_end + dowels.ceiling)});
}

}  // namespace fusee::solid
