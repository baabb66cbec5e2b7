/// \file
/// A tendon over drum and pin as a string laid by brute force. Both circles are polygons of a few thousand points, and
/// the string is the chain of points with all others on its inner side. Turns are counted by following the joint. No
/// formula of tendon_path.cpp is used.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "fusee/base.h"
#include "fusee/transmission.h"

namespace fusee::testing {

constexpr int k_string_points = 4096;
constexpr double k_string_step = k_two_pi / k_string_points;

/// Corners of a circle, counter-clockwise. The tendon runs upwards on its right side, as in the image of tendon 2.
inline std::vector<Vec2> circle(const Vec2& centre, double radius) {
  std::vector<Vec2> points;
  for (int i = 0; i < k_string_points; ++i)
    points.push_back(centre + radius * Vec2(std::cos(k_string_step * i), std::sin(k_string_step * i)));
  return points;
}

/// Positive if `point` lies to the right of the line from `from` to `to`.
inline double right_of(const Vec2& from, const Vec2& to, const Vec2& point) { return cross(point - from, to - from); }

/// Index of the tangent point of a circle for a string that runs from it towards `far`, or else from `far` to it: no
/// other point is on the string's right. The search begins at `start`.
inline int tangent_point(const std::vector<Vec2>& points, const Vec2& far, bool towards, int start) {
  // The tangent point moves round with the string, so a search from the last one is short.
  const auto leaves_outside = [&](int i, int other) {
    const Vec2 &a = points[static_cast<std::size_t>(i)], &b = points[static_cast<std::size_t>(other)];
    return towards ? right_of(a, far, b) > 0 : right_of(far, a, b) > 0;
  };
  int at = start;
  for (int walked = 0; walked < 2 * k_string_points; ++walked) {
    const int next = (at + 1) % k_string_points, before = (at + k_string_points - 1) % k_string_points;
    if (leaves_outside(at, next)) {
      at = next;
    } else if (leaves_outside(at, before)) {
      at = before;
    } else {
      return at;
    }
  }
  return at;
}

/// A string from the pin's rightmost point over any obstacles to the end.
class BruteString {
 public:
  explicit BruteString(const transmission::PinPlace& place)
      : place_(place), pin_(circle(place.pin(), place.rho)), drum_(circle({0, 0}, place.drum)) {
    // The common tangent with both circles on its left: its ends move in turn until no point is on its right.
    int i = 0, j = 0;
    for (int round = 0; round < 50; ++round) {
      const int i_before = i, j_before = j;
      i = tangent_point(pin_, drum_[static_cast<std::size_t>(j)], true, i);
      j = tangent_point(drum_, pin_[static_cast<std::size_t>(i)], false, j);
      if (i == i_before && j == j_before) break;
    }
    pin_leaves_ = i;
    drum_meets_ = j;
    // Starts with the end above the contact of string and drum, where the wrap is zero, and turns the joint to the
    // requested angle. Directions are counted from straight below O.
    const double meets = k_string_step * drum_meets_;
    turned_ = 0.5 * k_pi - (meets < 1.5 * k_pi ? meets : meets - k_two_pi);
    drum_leaves_ = tangent_point(drum_, end(), true, 0);
    wound_ = within_half_turn(drum_leaves_ - drum_meets_);
  }

  /// Length from the pin's point at direction (1, 0) to the end, mm; `theta` as tendon 2 sees it, rad.
  double length(double theta) {
    const double wanted = theta + place_.twist;
    // In steps of at most 0.2 rad, so that turns are counted correctly.
    const int steps = 1 + static_cast<int>(std::ceil(std::abs(wanted - turned_) / 0.2));
    const double from = turned_;
    for (int i = 1; i <= steps; ++i) {
      turned_ = from + (wanted - from) * i / steps;
      const int leaves = tangent_point(drum_, end(), true, drum_leaves_);
      wound_ += within_half_turn(leaves - drum_leaves_);
      drum_leaves_ = leaves;
    }
    if (wound_ > 0) {
      return round_pin(pin_leaves_) + distance(pin_leaves_, drum_[static_cast<std::size_t>(drum_meets_)]) +
             place_.drum * k_string_step * wound_ + (end() - drum_[static_cast<std::size_t>(drum_leaves_)]).norm();
    }
    const int leaves = tangent_point(pin_, end(), true, pin_leaves_);
    return round_pin(leaves) + distance(leaves, end());
  }
  bool is_wound() const { return wound_ > 0; }

 private:
  /// A number of points modulo a turn: at most half a turn either way.
  static int within_half_turn(int points) {
    return points - k_string_points * static_cast<int>(std::lround(points / double(k_string_points)));
  }
  Vec2 end() const { return place_.R * Vec2(std::sin(turned_), std::cos(turned_)); }
  double distance(int i, const Vec2& to) const { return (to - pin_[static_cast<std::size_t>(i)]).norm(); }
  /// Length along the pin from the tangent point of the line to the drum, less than half a turn either way.
  double round_pin(int i) const { return place_.rho * k_string_step * within_half_turn(i - pin_leaves_); }

  transmission::PinPlace place_;
  std::vector<Vec2> pin_, drum_;
  int pin_leaves_ = 0, drum_meets_ = 0, drum_leaves_ = 0;
  int wound_ = 0;      ///< points in contact, turns counted; negative: the string is clear of the drum
  double turned_ = 0;  ///< angle of the tendon's end, clockwise from straight up, rad
};

}  // namespace fusee::testing
