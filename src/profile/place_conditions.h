/// \file
/// What a drum, and attachments of their own, ask for beside what every joint does. Nothing is said of a plain joint.
#pragma once

#include <vector>

#include "fusee/profile/synthesis.h"
#include "profile/take_off.h"

namespace fusee {

/// Before any tendon is looked at: attachments outside the drum, pins clear of it.
std::vector<Condition> place_conditions(const Mechanism& mechanism);

/// How far the centre line of a tendon's upper half, at joint angle `theta` of its image, keeps from a point there. mm
double upper_clearance(const PinPlace& place, double theta, const Vec2& point);
/// The other tendon's pin in the image of `side`.
Vec2 other_pin(const Transmission& transmission, Side side);

/// Joint angles of the image of `side` at which one of the tendons leaves its drum, strictly within the range: there
/// moment arms have a kink.
std::vector<double> lift_offs(const Mechanism& mechanism, const Transmission& transmission, Side side);
/// On either side of each of them, where the one or the other branch holds. rad
constexpr double k_beside_lift_off = 1e-9;

/// A kink of r at the joint angle `image_theta` as the pitch curve has it: a straight piece of this length, or where it
/// is negative a hollow that no curve has. mm
double straight_piece(const TakeOffs& take_offs, double image_theta);
/// Longer ones are pieces; shorter ones, of either sign, are none.
constexpr double k_least_straight = 1e-6;

}  // namespace fusee
