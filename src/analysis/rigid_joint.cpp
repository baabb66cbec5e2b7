#include "analysis/rigid_joint.h"

#include <cmath>

namespace fusee {

RigidJoint::RigidJoint(const MadePulleys& made, const Mechanism& mounted)
    : made_(made),
      pins_{pin_place(mounted, Side::left, mounted.guide_pitch_radius()), pin_place(mounted, Side::right, mounted.guide_pitch_radius())} {
  const std::array<LowerPath, 2> paths = lower(0.0);
  for (std::size_t i = 0; i < 2; ++i) home_[i] = upper_span(pins_[i], 0.0).length + below(i, paths[i]);
}

RigidPoint RigidJoint::at(double alpha) const {
  const std::array<LowerPath, 2> paths = lower(alpha);
  const double wanted = home_[0] - below(0, paths[0]);
  RigidPoint point;
  point.theta = made_.declared().theta(alpha);
  // The upper span of tendon 1 grows with θ by its moment arm: Newton's steps.
  for (int i = 0; i < 30; ++i) {
    const UpperSpan span = upper_span(pins_[0], -point.theta);
    const double step = (span.length - wanted) / span.m;
    point.theta -= step;
    if (!(std::abs(step) > 1e-14)) break;
  }
  point.slack = home_[1] - below(1, paths[1]) - upper_span(pins_[1], point.theta).length;
  return point;
}

// A tendon's path is the shortest one round pin and pulley: moving a part changes its length only by what the straight pieces pull
// on that part, and growing a round part by the angle over which the tendon lies on it. With t_u from the pin to C and t_l from
// the pulley to the pin: C gives t_u·dC, the pin (t_l − t_u)·dP, the pulley −t_l·dG, the pin's radius φ, the pitch curve ψ + α.
namespace {

Vec2 upper_direction(const PinPlace& pin, double theta) { return turned_left(unit(upper_span(pin, theta).normal)); }
Vec2 lower_direction(const LowerPath& lower) { return turned_left(unit(lower.normal)); }

double by_length(const PinPlace& pin, const LowerPath&, Side, double theta, double) {
  return upper_direction(pin, theta).dot(Vec2(std::sin(theta), std::cos(theta)));
}
template <Side moved>
double by_pin(const PinPlace& pin, const LowerPath& lower, Side side, double theta, double) {
  return side == moved ? lower_direction(lower).x() - upper_direction(pin, theta).x() : 0.0;
}
double by_height(const PinPlace& pin, const LowerPath&, Side, double theta, double) { return upper_direction(pin, theta).y(); }
double by_pulley_place(const PinPlace&, const LowerPath& lower, Side, double, double) { return lower_direction(lower).y(); }
double by_pin_radius(const PinPlace& pin, const LowerPath& lower, Side, double theta, double) {
  return upper_span(pin, theta).normal - lower.normal;
}
double by_offset(const PinPlace&, const LowerPath& lower, Side, double, double alpha) { return lower.normal + alpha; }
double by_diameter(const PinPlace& pin, const LowerPath& lower, Side side, double theta, double alpha) {
  return 0.5 * (by_pin_radius(pin, lower, side, theta, alpha) + by_offset(pin, lower, side, theta, alpha));
}

/// What can come out otherwise: numbers of the mechanism, and both pitch curves by an offset.
struct Change {
  Mechanism mounted;
  double offset = 0;
};

void change_length(Change& to, double by) { to.mounted.joint.R += by; }
void change_left(Change& to, double by) { to.mounted.guides.EB += by; }
void change_right(Change& to, double by) { to.mounted.guides.ED += by; }
void change_height(Change& to, double by) { to.mounted.guides.OE += by; }
void change_radius(Change& to, double by) { to.mounted.guides.radius += by; }
void change_pulley(Change& to, double by) { to.mounted.pulley.EF += by; }
void change_offset(Change& to, double by) { to.offset += by; }
/// The groove's floor stays where it is: a thicker tendon lies further out on pulley and pin.
void change_diameter(Change& to, double by) {
  to.mounted.tendon.diameter += by;
  to.offset += 0.5 * by;
}

RigidJoint joint_of(const MadePulleys& made, const Change& change) { return {made.offset_by(change.offset), change.mounted}; }

template <void (*apply)(Change&, double)>
RigidJoint changed_by(const MadePulleys& made, const Mechanism& mechanism, double by) {
  Change change{mechanism, 0.0};
  apply(change, by);
  return joint_of(made, change);
}

}  // namespace

const std::vector<Dimension>& dimensions() {
  static const std::vector<Dimension> all = {
      {"joint.length_mm", changed_by<change_length>, by_length},      {"guides.EB_mm", changed_by<change_left>, by_pin<Side::left>},
      {"guides.ED_mm", changed_by<change_right>, by_pin<Side::right>}, {"guides.OE_mm", changed_by<change_height>, by_height},
      {"guides.radius_mm", changed_by<change_radius>, by_pin_radius},  {"pulley.EF_mm", changed_by<change_pulley>, by_pulley_place},
      {"tendon.diameter_mm", changed_by<change_diameter>, by_diameter}, {"print_offset", changed_by<change_offset>, by_offset}};
  return all;
}

RigidJoint all_changed(const MadePulleys& made, const Mechanism& mechanism, const std::vector<double>& changes) {
  constexpr std::array appliers = {change_length, change_left, change_right, change_height, change_radius, change_pulley, change_diameter, change_offset};
  Change change{mechanism, 0.0};
  for (std::size_t i = 0; i < appliers.size(); ++i) appliers[i](change, changes.at(i));
  return joint_of(made, change);
}

RigidPoint derivative(const RigidJoint& joint, const Dimension& dimension, double alpha) {
  const double theta = joint.at(alpha).theta;
  const std::array<LowerPath, 2> here = joint.lower(alpha);
  const std::array<LowerPath, 2> home = joint.lower(0.0);
  // By how much more the path grew here than at home, where the tendon's length was set.
  const auto grown = [&](std::size_t i, Side side) {
    const double sign = mirror_sign(side);
    return dimension.lengthens(joint.pins()[i], here[i], side, sign * theta, sign * alpha) -
           dimension.lengthens(joint.pins()[i], home[i], side, 0.0, 0.0);
  };
  RigidPoint rate;
  rate.theta = -grown(0, Side::left) / upper_span(joint.pins()[0], -theta).m;
  rate.slack = upper_span(joint.pins()[1], theta).m * rate.theta - grown(1, Side::right);
  return rate;
}

}  // namespace fusee
