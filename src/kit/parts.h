/// \file
/// Internal: from places and sizes to bodies. mm
#pragma once

#include <optional>

#include "fusee/kit/kit.h"

namespace fusee {

inline constexpr double k_leg_radius = 5;
inline constexpr double k_wall = 1.2;  ///< three lines of a 0.4 mm nozzle
inline constexpr double k_collar_height = 2.5;
inline constexpr double k_scale_reach = 10;  ///< from the pointer's tip to the edge of the scale

/// Along the tensioner's slide, from C outwards: under the screw that clamps the tendon, a wall, the nut, a wall.
struct SlideLengths {
  double clamp, back, nut, front;
  double whole() const { return clamp + back + nut + front; }
};
SlideLengths slide_lengths(const Thread& thread);
/// Of the tensioner's screw above the link.
double tensioner_axis(const Thread& thread);
double tensioner_height(const Thread& thread);

/// Diameter of the motor's shaft.
double shaft_of(const Mechanism& mechanism, const BodyLayout& layout);

/// Of the cone on the post, below tendon 2.
double post_steepness(const Mechanism& mechanism);

/// Fills parts, items and tendons of a plan whose conditions hold.
void make_parts(KitPlan& plan, const Mechanism& mechanism, const BodyLayout& layout);

/// Of a joint that is not the paper's, or whose tendons climb: plates to drill by, and its drum.
KitPlan plan_template(const Mechanism& mechanism, const BodyLayout& layout,
                      const std::optional<TendonHeights>& heights);

/// "-20" in strokes that do not touch, to be engraved: `up` is the digits' height.
std::vector<DiscHull> number_strokes(int number, const Vec2& middle, const Vec2& up);

}  // namespace fusee
