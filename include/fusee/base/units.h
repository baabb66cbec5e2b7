/// \file
/// Angles are radians in code and degrees in files and flags. Lengths are mm.
#pragma once

#include <numbers>

namespace fusee {

inline constexpr double k_pi = std::numbers::pi;
inline constexpr double k_two_pi = 2.0 * std::numbers::pi;

constexpr double radians(double degrees) { return degrees * (k_pi / 180.0); }
/// The inverse of radians(): by division, so that a number of a file is written back with its own digits.
constexpr double degrees(double radians) { return radians / (k_pi / 180.0); }

}  // namespace fusee
