/// \file
/// Additional conditions for drums and separate attachments. None for a plain joint.
#pragma once

#include <string>
#include <vector>

#include "fusee/profile.h"
#include "profile/take_off.h"

namespace fusee::profile {

/// "1" for tendon 1 and P1 (left), "2" for tendon 2 and P2.
std::string side_digit(transmission::Side side);
/// "B" for tendon 1 (left), "D" for tendon 2.
std::string pin_name(transmission::Side side);

/// Conditions that do not depend on tendon paths: attachments outside the drum, pins clear of it.
std::vector<Condition> place_conditions(const Mechanism& mechanism);

/// Distance of a point from the centre line of a tendon's upper half, at joint angle `theta` of its image. mm
double upper_clearance(const transmission::PinPlace& place, double theta, const Vec2& point);
/// The other tendon's pin in the image of `side`.
Vec2 other_pin(const transmission::Transmission& transmission, transmission::Side side);

/// Joint angles of the image of `side`, strictly within the range, at which a tendon leaves its drum. Moment arms have
/// a kink there.
std::vector<double> lift_offs(const Mechanism& mechanism, const transmission::Transmission& transmission,
                              transmission::Side side);
/// Distance from a lift-off angle at which only one branch applies. rad
constexpr double k_beside_lift_off = 1e-9;

/// Length of the straight part of the pitch curve that a kink of r at the joint angle `image_theta` causes. Negative:
/// the curve would need a hollow, which no pitch curve can have. mm
double straight_length(const TakeOffs& take_offs, double image_theta);
/// Shorter straight parts, of either sign, are ignored. mm
constexpr double k_least_straight = 1e-6;

}  // namespace fusee::profile
