#include "analysis/rigid_joint.h"

#include <cmath>

namespace fusee::analysis {

RigidJoint::RigidJoint(const joint::MadePulleys& made, const Mechanism& mounted)
    : made_(made),
      pins_{transmission::pin_place(mounted, transmission::Side::left, mounted.guide_pitch_radius()),
            transmission::pin_place(mounted, transmission::Side::right, mounted.guide_pitch_radius())} {
  const std::array<joint::LowerPath, 2> paths = lower(0.0);
  for (std::size_t i = 0; i < 2; ++i)
    home_[i] = transmission::upper_span(pins_[i], 0.0).length + length_below_pin(i, paths[i]);
}

RigidPoint RigidJoint::at(double alpha) const {
  const std::array<joint::LowerPath, 2> paths = lower(alpha);
  const double upper_length = home_[0] - length_below_pin(0, paths[0]);
  RigidPoint point;
  point.theta = made_.declared().theta(alpha);
  // The upper span of tendon 1 grows with θ by its moment arm: Newton steps.
  constexpr int k_most_steps = 30;
  constexpr double k_last_step = 1e-14;  // rad
  for (int i = 0; i < k_most_steps; ++i) {
    const transmission::UpperSpan span = transmission::upper_span(pins_[0], -point.theta);
    const double step = (span.length - upper_length) / span.m;
    point.theta -= step;
    if (!(std::abs(step) > k_last_step)) break;
  }
  point.excess = home_[1] - length_below_pin(1, paths[1]) - transmission::upper_span(pins_[1], point.theta).length;
  return point;
}

// A tendon's path is the shortest one round pin and pulley. Moving a part therefore changes its length only by the
// component along the straight parts, and enlarging a round part by the wrap angle on it. With t_u from the pin to C
// and t_l from the pulley to the pin: C contributes t_u·dC, the pin (t_l − t_u)·dP, the pulley −t_l·dG, the pin's
// radius φ, the pitch curve ψ + α.
namespace {

Vec2 upper_direction(const transmission::PinPlace& pin, double theta) {
  return turned_left(unit(transmission::upper_span(pin, theta).normal));
}
Vec2 lower_direction(const joint::LowerPath& lower) { return turned_left(unit(lower.normal)); }

/// Direction from the last contact (pin or drum) to the tendon's end.
Vec2 end_direction(const transmission::PinPlace& pin, double theta) {
  return turned_left(unit(transmission::upper_span(pin, theta).end_normal));
}
double by_length(const transmission::PinPlace& pin, const joint::LowerPath&, transmission::Side, double theta, double) {
  return pin.at_C ? end_direction(pin, theta).dot(Vec2(elementary::sin(theta), elementary::cos(theta))) : 0.0;
}
/// The tendon ends do not move in the link.
double by_drum(const transmission::PinPlace& pin, const joint::LowerPath&, transmission::Side, double theta, double) {
  return transmission::upper_span(pin, theta).on_drum;
}
/// The displacement is in the mechanism's axes; in the left tendon's image the x axis is reversed.
template <transmission::Side moved, bool is_across>
double by_end(const transmission::PinPlace& pin, const joint::LowerPath&, transmission::Side side, double theta,
              double) {
  if (side != moved || pin.at_C) return 0.0;
  const Vec2 across(elementary::cos(theta), -elementary::sin(theta)),
      along(elementary::sin(theta), elementary::cos(theta));
  return end_direction(pin, theta).dot(is_across ? Vec2(transmission::mirror_sign(side) * across) : along);
}
template <transmission::Side moved>
double by_pin(const transmission::PinPlace& pin, const joint::LowerPath& lower, transmission::Side side, double theta,
              double) {
  // A sheath is held by the pin, follows it and keeps its length.
  const double pulled = pin.sheath_exit ? 0.0 : lower_direction(lower).x();
  return side == moved ? pulled - upper_direction(pin, theta).x() : 0.0;
}
double by_height(const transmission::PinPlace& pin, const joint::LowerPath&, transmission::Side, double theta, double) {
  return upper_direction(pin, theta).y();
}
double by_pulley_place(const transmission::PinPlace&, const joint::LowerPath& lower, transmission::Side, double,
                       double) {
  return lower_direction(lower).y();
}
/// The sheath exits move apart, outwards in each tendon's image.
double by_exit_across(const transmission::PinPlace&, const joint::LowerPath& lower, transmission::Side, double,
                      double) {
  return lower_direction(lower).x();
}
double by_pin_radius(const transmission::PinPlace& pin, const joint::LowerPath& lower, transmission::Side, double theta,
                     double) {
  return transmission::upper_span(pin, theta).normal - pin.off_pin(lower.normal);
}
double by_offset(const transmission::PinPlace&, const joint::LowerPath& lower, transmission::Side, double,
                 double alpha) {
  return lower.normal + alpha;
}
double by_diameter(const transmission::PinPlace& pin, const joint::LowerPath& lower, transmission::Side side,
                   double theta, double alpha) {
  return 0.5 * (by_pin_radius(pin, lower, side, theta, alpha) + by_offset(pin, lower, side, theta, alpha) +
                transmission::upper_span(pin, theta).on_drum);
}

void alter_length(Alteration& joint, double change) { joint.mounted.joint.R += change; }
void alter_drum(Alteration& joint, double change) { joint.mounted.joint.drum_radius += change; }
template <std::optional<Attachment> Joint::*end, double Attachment::*axis>
void alter_end(Alteration& joint, double change) {
  (joint.mounted.joint.*end).value().*axis += change;
}
void alter_left(Alteration& joint, double change) { joint.mounted.guides.EB += change; }
void alter_right(Alteration& joint, double change) { joint.mounted.guides.ED += change; }
void alter_height(Alteration& joint, double change) { joint.mounted.guides.OE += change; }
void alter_radius(Alteration& joint, double change) { joint.mounted.guides.radius += change; }
void alter_pulley_place(Alteration& joint, double change) { joint.mounted.pulley.EF += change; }
void alter_exit_across(Alteration& joint, double change) { joint.mounted.sheath.exit_across += change; }
void alter_exit_above(Alteration& joint, double change) { joint.mounted.sheath.exit_above += change; }
void alter_offset(Alteration& joint, double change) { joint.offset += change; }
/// The groove's floor does not move: a thicker tendon lies further out on pulley and pin.
void alter_diameter(Alteration& joint, double change) {
  joint.mounted.tendon.diameter += change;
  joint.offset += 0.5 * change;
}

RigidJoint joint_of(const joint::MadePulleys& made, const Alteration& joint) {
  return {made.offset_by(joint.offset), joint.mounted};
}

}  // namespace

std::vector<Dimension> dimensions(const Mechanism& mechanism) {
  std::vector<Dimension> all = {{"joint.length_mm", alter_length, by_length},
                                {"guides.EB_mm", alter_left, by_pin<transmission::Side::left>},
                                {"guides.ED_mm", alter_right, by_pin<transmission::Side::right>},
                                {"guides.OE_mm", alter_height, by_height},
                                {"guides.radius_mm", alter_radius, by_pin_radius},
                                {"pulley.EF_mm", alter_pulley_place, by_pulley_place},
                                {"tendon.diameter_mm", alter_diameter, by_diameter},
                                {"print_offset", alter_offset, by_offset}};
  if (mechanism.sheath.is_there()) {
    // Moving the sheath exits up is equivalent to moving the pulley down.
    std::erase_if(all, [](const Dimension& dimension) { return dimension.key == "pulley.EF_mm"; });
    all.push_back({"sheath.exit_across_mm", alter_exit_across, by_exit_across});
    all.push_back({"sheath.exit_above_mm", alter_exit_above, by_pulley_place});
  }
  const Joint& joint = mechanism.joint;
  if (joint.drum_radius > 0) all.push_back({"joint.drum_radius_mm", alter_drum, by_drum});
  constexpr auto first = &Joint::attachment1, second = &Joint::attachment2;
  if (joint.attachment1) {
    all.push_back(
        {"joint.attachment1_mm[0]", alter_end<first, &Attachment::across>, by_end<transmission::Side::left, true>});
    all.push_back(
        {"joint.attachment1_mm[1]", alter_end<first, &Attachment::along>, by_end<transmission::Side::left, false>});
  }
  if (joint.attachment2) {
    all.push_back(
        {"joint.attachment2_mm[0]", alter_end<second, &Attachment::across>, by_end<transmission::Side::right, true>});
    all.push_back(
        {"joint.attachment2_mm[1]", alter_end<second, &Attachment::along>, by_end<transmission::Side::right, false>});
  }
  return all;
}

RigidJoint altered(const joint::MadePulleys& made, const Mechanism& mechanism, const Dimension& dimension,
                   double change) {
  Alteration joint{mechanism, 0.0};
  dimension.alter(joint, change);
  return joint_of(made, joint);
}

RigidJoint altered(const joint::MadePulleys& made, const Mechanism& mechanism, const std::vector<double>& changes) {
  Alteration joint{mechanism, 0.0};
  const std::vector<Dimension> all = dimensions(mechanism);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].alter(joint, changes.at(i));
  return joint_of(made, joint);
}

RigidPoint derivative(const RigidJoint& joint, const Dimension& dimension, double alpha) {
  const double theta = joint.at(alpha).theta;
  const std::array<joint::LowerPath, 2> here = joint.lower(alpha);
  const std::array<joint::LowerPath, 2> home = joint.lower(0.0);
  // Growth of the path relative to home, where the tendon's length was set.
  const auto growth = [&](std::size_t i, transmission::Side side) {
    const double sign = transmission::mirror_sign(side);
    return dimension.lengthens(joint.pins()[i], here[i], side, sign * theta, sign * alpha) -
           dimension.lengthens(joint.pins()[i], home[i], side, 0.0, 0.0);
  };
  RigidPoint rate;
  rate.theta = -growth(0, transmission::Side::left) / transmission::upper_span(joint.pins()[0], -theta).m;
  rate.excess = transmission::upper_span(joint.pins()[1], theta).m * rate.theta - growth(1, transmission::Side::right);
  return rate;
}

}  // namespace fusee::analysis
