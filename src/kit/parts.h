/// \file
/// Internal: builds the bodies of the rig's parts from their places and sizes. mm
#pragma once

#include <optional>

#include "fusee/kit.h"

namespace fusee::kit {

// Sizes that all rigs share, mm.
inline constexpr double k_leg_radius = 5;
inline constexpr double k_wall = 1.2;  ///< three lines of a 0.4 mm nozzle
inline constexpr double k_collar_height = 2.5;
inline constexpr double k_layer_gap = 1.5;      ///< between parts that move over each other, in height
inline constexpr double k_board_spacer = 3;     ///< height of the spacers between bracket and board
inline constexpr double k_post_to_slide = 2.5;  ///< distance of the tensioner's slide from the post at C
inline constexpr double k_scale_reach = 10;     ///< distance of the scale's outer edge beyond the pointer's tip

/// Lengths along the tensioner's slide, in the direction from C to the link's end: the seat of the clamping screw, a
/// wall, the slot of the nut, a wall. mm
struct SlideLengths {
  double clamp, back, nut, front;
  double whole() const { return clamp + back + nut + front; }
};
SlideLengths slide_lengths(const Thread& thread);
/// Height of the tensioner's screw above the link.
double tensioner_axis(const Thread& thread);
/// Height of the tensioner's wall above the link.
double tensioner_height(const Thread& thread);

/// Diameter of the motor's shaft.
double shaft_of(const Mechanism& mechanism, const solid::BodyLayout& layout);

/// Slope (tangent) of the cone on the post below tendon 2.
double post_steepness(const Mechanism& mechanism);

/// Fills in parts, items and tendons. Requires a plan whose conditions hold.
void make_parts(KitPlan& plan, const Mechanism& mechanism, const solid::BodyLayout& layout);

/// The kit of a joint outside the paper's layout or with helical tendons: plates to drill, and the drum.
KitPlan plan_template(const Mechanism& mechanism, const solid::BodyLayout& layout,
                      const std::optional<TendonHeights>& heights);

/// Strokes of a number such as "-20" for engraving, which do not touch. `up`: unit vector towards the top of the
/// digits.
std::vector<DiscHull> number_strokes(int number, const Vec2& middle, const Vec2& up);

}  // namespace fusee::kit
