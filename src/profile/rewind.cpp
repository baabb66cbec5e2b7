#include "fusee/profile/rewind.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"
#include "fusee/transmission/transmission.h"
#include "transmission/alpha_range.h"

// The second route. Nothing here knows a support function, a derivative or an envelope: a string is laid round the corners of a
// polygon, over a disc and to a point, its length is added up piece by piece, and the joint angle at which that length
// is what it was at home is found by bisection.

namespace fusee {
namespace {

/// `angle` turned by full turns to within half a turn of `near`.
double turned_near(double angle, double near) { return angle - k_two_pi * std::round((angle - near) / k_two_pi); }

double direction(const Vec2& v) { return std::atan2(v.y(), v.x()); }

/// The centre of a string's pin, seen from the joint.
Vec2 pin_of(const Mechanism& mechanism, double hand) {
  const Guides& guides = mechanism.guides;
  return hand > 0 ? Vec2(guides.ED, -guides.OE - guides.D_below_B) : Vec2(-guides.EB, -guides.OE);
}

/// Where a string ends in the link at home.
Vec2 end_of(const Mechanism& mechanism, double hand) {
  const Joint& joint = mechanism.joint;
  const auto& own = hand > 0 ? joint.attachment2 : joint.attachment1;
  return own ? Vec2(own->across, own->along) : Vec2(0.0, joint.R);
}

/// What a string comes to its pulley from, seen from the pulley's axis: its pin, or the mouth of its sheath.
Vec2 above_pulley(const Mechanism& mechanism, double hand) {
  if (mechanism.sheath.is_there()) return {hand * mechanism.sheath.exit_across, mechanism.sheath.exit_above};
  const Vec2 pin = pin_of(mechanism, hand);
  return {pin.x(), pin.y() + mechanism.guides.OE + mechanism.pulley.EF};
}

/// One string on its pulley, sheath, pin, drum and joint. `hand` is +1 for tendon 2 on the right, −1 for tendon 1 on
/// the left.
class String {
 public:
  String(const Mechanism& mechanism, const Polygon& floor, double hand)
      : corners_(convex_hull(floor)),
        hand_(hand),
        half_(0.5 * mechanism.tendon.diameter),
        rho_(mechanism.guides.radius + half_),
        sheathed_(mechanism.sheath.is_there()),
        lower_rho_(sheathed_ ? 0.0 : rho_),
        end_(end_of(mechanism, hand)),
        drum_(mechanism.joint.drum_radius != 0 ? mechanism.joint.drum_radius + half_ : 0.0),
        drum_centre_(mechanism.joint.drum_centre.across, mechanism.joint.drum_centre.along),
        pin_(pin_of(mechanism, hand)),
        from_axis_(above_pulley(mechanism, hand)) {
    const std::string name = pulley_name();
    // Out of the drum a string comes at its own height.
    if (const double away = (end_ - drum_centre_).norm(); away < drum_)
      end_ = drum_centre_ + drum_ / away * (end_ - drum_centre_);
    if (drum_ > 0 && !(pin_.norm() - drum_centre_.norm() > drum_ - half_ + mechanism.guides.radius))
      throw InputError("", "a guide pin stands in the drum", "joint.drum_radius_mm smaller, or pins further out");
    if (corners_.size() < 3) throw InputError("", "the groove floor of " + name + " is not a closed curve with an inside");
    double along = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vec2& next = corners_[(i + 1) % corners_.size()];
      if (cross(corners_[i], next) <= 0) throw InputError("", "the groove floor of " + name + " does not surround the axis");
      along_.push_back(along);
      along += (next - corners_[i]).norm();
      const double normal = direction(next - corners_[i]) - 0.5 * k_pi;
      edge_normals_.push_back(i == 0 ? normal : turned_near(normal, edge_normals_.back()));
    }
    girth_ = along;
    turn_to(0.0);
    home_length_ = length(0.0);
  }

  /// Moves the pulley; small steps, so that turns are counted.
  void turn_to(double alpha) {
    alpha_ = alpha;
    // Seen from the pulley, which turns clockwise, the world turns the other way.
    const Vec2 pin(std::cos(alpha) * from_axis_.x() - std::sin(alpha) * from_axis_.y(),
                   std::sin(alpha) * from_axis_.x() + std::cos(alpha) * from_axis_.y());
    find_corner(pin);
    const double normal = tangent_normal(pin, corner_);
    normal_ = started_ ? turned_near(normal, normal_) : normal;
    started_ = true;
    const double reach = (pin - corners_[corner_]).norm();
    span_ = std::sqrt((reach - (half_ - lower_rho_)) * (reach + (half_ - lower_rho_)));
    if (!(span_ > 0)) {
      throw InputError(
          "", "the groove floor of " + pulley_name() + " swallows its " + (sheathed_ ? "sheath's mouth" : "guide pin"));
    }
  }

  /// By how much the way from a fixed place of the pulley to the joint at `theta` is longer than at home.
  double excess(double theta) const { return length(theta) - home_length_; }

  double hand() const { return hand_; }
  std::string name() const { return hand_ > 0 ? "tendon 2" : "tendon 1"; }

 private:
  std::string pulley_name() const { return hand_ > 0 ? "P2" : "P1"; }

  /// But for a constant.
  double length(double theta) const { return hand_ * wound() + span_ + over_pin_and_up(theta); }

  /// Outward normal of the line that touches the disc about a corner and the pin's disc (or goes through the mouth),
  /// both on their outer side.
  double tangent_normal(const Vec2& pin, std::size_t corner) const {
    const Vec2 away = pin - corners_[corner];
    return direction(away) - hand_ * std::acos(std::clamp((half_ - lower_rho_) / away.norm(), -1.0, 1.0));
  }

  /// Walks to the corner whose tangent leaves all others inside.
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
    // Two neighbours that each point to the other, by rounding: both are right.
  }

  /// Counter-clockwise along the centre line on the pulley, full turns included: edges passed, and arcs of d/2 about the corners.
  double wound() const {
    const double before = corner_ == 0 ? edge_normals_.back() - k_two_pi : edge_normals_[corner_ - 1];
    const double turns = std::round((normal_ - 0.5 * (before + edge_normals_[corner_])) / k_two_pi);
    return along_[corner_] + girth_ * turns + half_ * normal_;
  }

  /// What joins two discs with the string on the outer side of both, or a disc and a point.
  struct Piece {
    double normal = 0;  ///< outward, rad
    double length = 0;
  };
  Piece from_pin_to(const Vec2& centre, double radius) const {
    const Vec2 away = centre - pin_;
    const double distance = away.norm(), larger = rho_ - radius;
    return {direction(away) - hand_ * std::acos(std::clamp(larger / distance, -1.0, 1.0)),
            std::sqrt(std::max(0.0, (distance - larger) * (distance + larger)))};
  }

  double over_pin_and_up(double theta) const {
    const Vec2 end = with_link(end_, theta);
    Piece up = from_pin_to(end, 0.0);
    const double wound = drum_ > 0 ? wound_on_drum(theta) : 0.0;
    if (wound > 0) {
      const Vec2 centre = with_link(drum_centre_, theta);
      const double away = (end - centre).norm();
      up = from_pin_to(centre, drum_);
      up.length += drum_ * wound + std::sqrt(std::max(0.0, (away - drum_) * (away + drum_)));
    }
    // Into a sheath it goes straight down from the pin's outer side; what lies in there keeps its length.
    const double lower_normal = !sheathed_ ? normal_ - alpha_ : hand_ > 0 ? 0.0 : k_pi;
    const double wrap = turned_near(hand_ * (up.normal - lower_normal), 0.5 * k_pi);
    return rho_ * wrap + up.length;
  }

  /// Over which angle the string lies on the drum; it is free of it below 0. An end at home is reached over the drum's
  /// outer side: both its direction and the pin's are counted from straight below O, the string's own way round.
  double wound_on_drum(double theta) const {
    const auto counted = [this](double angle) {
      const double own = hand_ > 0 ? angle : k_pi - angle;
      return turned_near(own, 0.5 * k_pi);
    };
    const Vec2 from_centre = end_ - drum_centre_;
    const double tangent =
        counted(direction(from_centre)) - std::acos(std::clamp(drum_ / from_centre.norm(), -1.0, 1.0));
    return tangent - counted(from_pin_to(with_link(drum_centre_, theta), drum_).normal) - hand_ * theta;
  }

  /// Where a place of the link at home is, turned clockwise with it.
  static Vec2 with_link(const Vec2& home, double theta) {
    return {std::cos(theta) * home.x() + std::sin(theta) * home.y(),
            std::cos(theta) * home.y() - std::sin(theta) * home.x()};
  }

  Polygon corners_;
  std::vector<double> along_;         ///< length of the edges before each corner
  std::vector<double> edge_normals_;  ///< of the edge that leaves each corner, increasing
  double girth_ = 0;
  double home_length_ = 0;
  double hand_;
  double half_;
  double rho_;
  bool sheathed_;
  double lower_rho_;  ///< of what it comes to the pulley from; 0: a mouth
  Vec2 end_;          ///< in the link at home
  double drum_;       ///< to the string's centre line; 0: none
  Vec2 drum_centre_;  ///< in the link at home
  Vec2 pin_;          ///< in the world
  Vec2 from_axis_;    ///< what it comes to the pulley from, seen from the axis at home

  double alpha_ = 0;
  std::size_t corner_ = 0;
  double normal_ = 0;  ///< of the lower span in the pulley's frame, turns counted
  double span_ = 0;
  bool started_ = false;
};

/// The joint angle at which the string is as long as at home. Its length grows with θ on the left and falls on the right,
/// up to the dead centre: so the bracket starts narrow.
double taut_theta(const String& string, double alpha, double guess) {
  const auto growing = [&string](double theta) { return -string.hand() * string.excess(theta); };
  double reach = 0.005;
  while (!(growing(guess - reach) < 0 && growing(guess + reach) > 0)) {
    reach *= 2;
    if (reach > 0.7) {
      throw InputError("", "no joint angle near the declared one makes " + string.name() + " taut at α = " + rounded(degrees(alpha), 4) + "°",
                       "is this the pulley of this mechanism, in mm, its axis at the origin?");
    }
  }
  double low = guess - reach;
  double high = guess + reach;
  for (int i = 0; i < 52; ++i) {
    const double middle = 0.5 * (low + high);
    (growing(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Transmission law_without_dead_centre(const Mechanism& mechanism) {
  Transmission declared(mechanism);
  if (const auto dead = declared.dead_centre()) {
    throw InputError("", "the declared law ends at a dead centre, θ = " + rounded(degrees(*dead), 4) + "°", "make the range smaller");
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
    if (std::abs(point.slack) >= result.max_slack) {
      result.max_slack = std::abs(point.slack);
      result.max_slack_at = point.alpha;
    }
  }
}

/// The joint held by the first string; the slack is that of the last, none where it is the first.
RewindResult wind(const Transmission& declared, std::vector<String> strings, int steps) {
  const auto turn_to = [&strings](double alpha) {
    for (String& string : strings) string.turn_to(alpha);
  };
  RewindResult result;
  // From home to one end and back through home to the other, so that turns are counted without a jump.
  for (int i = 0; i < steps; ++i) turn_to(declared.alpha_min() * i / steps);
  for (const double alpha : alphas_over_range(declared, steps)) {
    turn_to(alpha);
    RewindPoint point{alpha, declared.theta(alpha), 0, 0};
    point.theta = taut_theta(strings.front(), alpha, point.theta_declared);
    if (strings.size() > 1) point.slack = -strings.back().excess(point.theta);
    result.points.push_back(point);
  }
  note_largest(result);
  return result;
}

}  // namespace

RewindResult rewind(const Mechanism& mechanism, const Polygon& floor1, const Polygon& floor2, int steps) {
  const Transmission declared = law_without_dead_centre(mechanism);
  return wind(declared, {String(mechanism, floor1, -1.0), String(mechanism, floor2, +1.0)}, steps);
}

RewindResult rewind_one(const Mechanism& mechanism, Side side, const Polygon& floor, int steps) {
  const Transmission declared = law_without_dead_centre(mechanism);
  return wind(declared, {String(mechanism, floor, side == Side::left ? -1.0 : +1.0)}, steps);
}

}  // namespace fusee
