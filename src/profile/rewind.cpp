#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/profile.h"
#include "fusee/transmission.h"
#include "profile/string_above.h"
#include "transmission/alpha_range.h"

// Independent verification: no support functions, derivatives or envelopes. A string is laid round the corners of a
// polygon, over a disc and to a point. Its length is summed piece by piece, and bisection finds the joint angle at
// which the length equals that at home.

namespace fusee::profile {
namespace {

/// One string on pulley, pin, drum and joint. `hand` is +1 for tendon 2 on the right, −1 for tendon 1 on the left.
class String {
 public:
  String(const Mechanism& mechanism, const Polygon& floor, double hand)
      : corners_(convex_hull(floor)), hand_(hand), half_(0.5 * mechanism.tendon.diameter), above_(mechanism, hand) {
    const std::string name = pulley_name();
    if (corners_.size() < 3)
      throw InputError("", "the groove floor of " + name + " is not a closed curve with an inside");
    double along = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vec2& next = corners_[(i + 1) % corners_.size()];
      if (cross(corners_[i], next) <= 0)
        throw InputError("", "the groove floor of " + name + " does not surround the axis");
      along_.push_back(along);
      along += (next - corners_[i]).norm();
      const double normal = direction(next - corners_[i]) - 0.5 * k_pi;
      edge_normals_.push_back(i == 0 ? normal : turned_near(normal, edge_normals_.back()));
    }
    girth_ = along;
    turn_to(0.0);
    home_length_ = length(0.0);
  }

  /// Turns the pulley. Steps must be small, so that turns are counted.
  void turn_to(double alpha) {
    alpha_ = alpha;
    const Vec2 pin = above_.guide_seen_from_pulley(alpha);
    find_corner(pin);
    const double normal = tangent_normal(pin, corner_);
    normal_ = started_ ? turned_near(normal, normal_) : normal;
    started_ = true;
    span_ = above_.lower_span(pin, corners_[corner_]);
    if (!(span_ > 0)) {
      throw InputError("", "the groove floor of " + pulley_name() + " contains its " +
                               (above_.is_sheathed() ? "sheath exit" : "guide pin"));
    }
  }

  /// Increase, relative to home, of the length from a fixed place of the pulley to the joint at `theta`.
  double excess(double theta) const { return length(theta) - home_length_; }

  double hand() const { return hand_; }
  std::string name() const { return hand_ > 0 ? "tendon 2" : "tendon 1"; }

 private:
  std::string pulley_name() const { return hand_ > 0 ? "P2" : "P1"; }

  /// The length up to a constant.
  double length(double theta) const { return hand_ * wound() + span_ + above_.length(theta, normal_ - alpha_); }

  double tangent_normal(const Vec2& pin, std::size_t corner) const {
    return above_.lower_normal(pin, corners_[corner]);
  }

  /// Moves to the corner whose tangent has all other corners inside.
  void find_corner(const Vec2& pin) {
    const std::size_t count = corners_.size();
    for (std::size_t steps = 0; steps < 2 * count; ++steps) {
      const double normal = tangent_normal(pin, corner_);
      const std::size_t before = (corner_ + count - 1) % count;
      if (turned_near(normal, edge_normals_[before]) < edge_normals_[before]) {
        corner_ = before;
      } else if (turned_near(normal, edge_normals_[corner_]) > edge_normals_[corner_]) {
        corner_ = (corner_ + 1) % count;
      } else {
        return;
      }
    }
    // Due to rounding, two neighbours may point to each other: both are valid.
  }

  /// Length wound counter-clockwise along the centre line, full turns included: passed edges, and arcs of radius d/2
  /// about the corners.
  double wound() const {
    const double before = corner_ == 0 ? edge_normals_.back() - k_two_pi : edge_normals_[corner_ - 1];
    const double turns = std::round((normal_ - 0.5 * (before + edge_normals_[corner_])) / k_two_pi);
    return along_[corner_] + girth_ * turns + half_ * normal_;
  }

  Polygon corners_;
  std::vector<double> along_;         ///< length of the edges before each corner
  std::vector<double> edge_normals_;  ///< normals of the edges that leave each corner, increasing
  double girth_ = 0;
  double home_length_ = 0;
  double hand_;
  double half_;  ///< half the string's thickness, mm
  StringAbove above_;

  double alpha_ = 0;
  std::size_t corner_ = 0;  ///< that the lower span touches
  double normal_ = 0;       ///< normal of the lower span in the pulley's frame, turns counted
  double span_ = 0;         ///< length of the lower span, mm
  bool started_ = false;
};

/// The joint angle at which the string has its length at home. The length increases with θ on the left and decreases on
/// the right up to the dead centre, so the bracket starts narrow.
double taut_theta(const String& string, double alpha, double guess) {
  constexpr double k_first_reach = 0.005, k_last_reach = 0.7;  // rad
  constexpr int k_bisections = 52;                             // to the last bit of a double
  const auto growing = [&string](double theta) { return -string.hand() * string.excess(theta); };
  double reach = k_first_reach;
  while (!(growing(guess - reach) < 0 && growing(guess + reach) > 0)) {
    reach *= 2;
    if (reach > k_last_reach) {
      throw InputError("",
                       "no joint angle near the declared one makes " + string.name() +
                           " taut at α = " + rounded(degrees(alpha), 4) + "°",
                       "is this the pulley of this mechanism, in mm, its axis at the origin?");
    }
  }
  double low = guess - reach;
  double high = guess + reach;
  for (int i = 0; i < k_bisections; ++i) {
    const double middle = 0.5 * (low + high);
    (growing(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The target motion. Throws InputError when it has a dead centre within the range.
transmission::Transmission law_without_dead_centre(const Mechanism& mechanism) {
  transmission::Transmission declared(mechanism);
  if (const auto dead = declared.dead_centre()) {
    throw InputError("", "the target motion ends at a dead centre, θ = " + rounded(degrees(*dead), 4) + "°",
                     "make the range smaller");
  }
  return declared;
}

void note_largest(RewindResult& result) {
  for (const RewindPoint& point : result.points) {
    const double error = std::abs(point.theta - point.theta_declared);
    if (error >= result.max_theta_error) {
      result.max_theta_error = error;
      result.max_theta_error_at = point.alpha;
    }
    if (std::abs(point.excess) >= result.max_excess) {
      result.max_excess = std::abs(point.excess);
      result.max_excess_at = point.alpha;
    }
  }
}

/// Winds with the joint held by the first string. The excess length is that of the last string, 0 if there is only one.
RewindResult wind(const transmission::Transmission& declared, std::vector<String> strings, int steps) {
  const auto turn_to = [&strings](double alpha) {
    for (String& string : strings) string.turn_to(alpha);
  };
  RewindResult result;
  // The strings turn from home to one end and back through home to the other, so that turns are counted without jumps.
  for (int i = 0; i < steps; ++i) turn_to(declared.alpha_min() * i / steps);
  for (const double alpha : transmission::alphas_over_range(declared, steps)) {
    turn_to(alpha);
    RewindPoint point{alpha, declared.theta(alpha), 0, 0};
    point.theta = taut_theta(strings.front(), alpha, point.theta_declared);
    if (strings.size() > 1) point.excess = -strings.back().excess(point.theta);
    result.points.push_back(point);
  }
  note_largest(result);
  return result;
}

}  // namespace

RewindResult rewind(const Mechanism& mechanism, const Polygon& floor1, const Polygon& floor2, int steps) {
  const transmission::Transmission declared = law_without_dead_centre(mechanism);
  return wind(declared, {String(mechanism, floor1, -1.0), String(mechanism, floor2, +1.0)}, steps);
}

RewindResult rewind_one(const Mechanism& mechanism, transmission::Side side, const Polygon& floor, int steps) {
  const transmission::Transmission declared = law_without_dead_centre(mechanism);
  return wind(declared, {String(mechanism, floor, side == transmission::Side::left ? -1.0 : +1.0)}, steps);
}

}  // namespace fusee::profile
