#include "profile/string_above.h"

#include <algorithm>

#include "fusee/base.h"

namespace fusee::profile {
namespace {

/// Centre of a string's pin, relative to the joint.
Vec2 pin_of(const Mechanism& mechanism, double hand) {
  const Guides& guides = mechanism.guides;
  return hand > 0 ? Vec2(guides.ED, -guides.OE - guides.D_below_B) : Vec2(-guides.EB, -guides.OE);
}

/// End of a string in the link at home.
Vec2 end_of(const Mechanism& mechanism, double hand) {
  const Joint& joint = mechanism.joint;
  const auto& own = hand > 0 ? joint.attachment2 : joint.attachment1;
  return own ? Vec2(own->across, own->along) : Vec2(0.0, joint.R);
}

/// The last guide before the pulley (pin or sheath exit), relative to the pulley's axis.
Vec2 above_pulley(const Mechanism& mechanism, double hand) {
  if (mechanism.sheath.is_there()) return {hand * mechanism.sheath.exit_across, mechanism.sheath.exit_above};
  const Vec2 pin = pin_of(mechanism, hand);
  return {pin.x(), pin.y() + mechanism.guides.OE + mechanism.pulley.EF};
}

/// A point of the link at home, turned clockwise with the link.
Vec2 with_link(const Vec2& home, double theta) {
  return {elementary::cos(theta) * home.x() + elementary::sin(theta) * home.y(),
          elementary::cos(theta) * home.y() - elementary::sin(theta) * home.x()};
}

}  // namespace

StringAbove::StringAbove(const Mechanism& mechanism, double hand)
    : hand_(hand),
      half_(0.5 * mechanism.tendon.diameter),
      rho_(mechanism.guides.radius + half_),
      sheathed_(mechanism.sheath.is_there()),
      end_(end_of(mechanism, hand)),
      drum_(mechanism.joint.drum_radius != 0 ? mechanism.joint.drum_radius + half_ : 0.0),
      drum_centre_(mechanism.joint.drum_centre.across, mechanism.joint.drum_centre.along),
      pin_(pin_of(mechanism, hand)),
      from_axis_(above_pulley(mechanism, hand)) {
  // A string leaves the drum at its pitch circle.
  if (const double away = (end_ - drum_centre_).norm(); away < drum_)
    end_ = drum_centre_ + drum_ / away * (end_ - drum_centre_);
  if (drum_ > 0 && !(pin_.norm() - drum_centre_.norm() > drum_ - half_ + mechanism.guides.radius))
    throw InputError("", "a guide pin lies inside the drum", "reduce joint.drum_radius_mm, or move the pins outwards");
}

/// In the frame of the pulley, which turns clockwise, the world turns counter-clockwise.
Vec2 StringAbove::guide_seen_from_pulley(double alpha) const {
  return {elementary::cos(alpha) * from_axis_.x() - elementary::sin(alpha) * from_axis_.y(),
          elementary::sin(alpha) * from_axis_.x() + elementary::cos(alpha) * from_axis_.y()};
}

double StringAbove::lower_normal(const Vec2& guide, const Vec2& corner) const {
  const Vec2 away = guide - corner;
  return direction(away) - hand_ * elementary::acos(std::clamp((half_ - lower_rho()) / away.norm(), -1.0, 1.0));
}

double StringAbove::lower_span(const Vec2& guide, const Vec2& corner) const {
  const double reach = (guide - corner).norm();
  return std::sqrt((reach - (half_ - lower_rho())) * (reach + (half_ - lower_rho())));
}

/// The line that touches two discs, or a disc and a point, with the string on their outer side.
StringAbove::Span StringAbove::from_pin_to(const Vec2& centre, double radius) const {
  const Vec2 away = centre - pin_;
  const double distance = away.norm(), larger = rho_ - radius;
  return {direction(away) - hand_ * elementary::acos(std::clamp(larger / distance, -1.0, 1.0)),
          std::sqrt(std::max(0.0, (distance - larger) * (distance + larger)))};
}

double StringAbove::length(double theta, double lower_normal) const {
  const Vec2 end = with_link(end_, theta);
  Span up = from_pin_to(end, 0.0);
  const double wound = drum_ > 0 ? wound_on_drum(theta) : 0.0;
  if (wound > 0) {
    const Vec2 centre = with_link(drum_centre_, theta);
    const double away = (end - centre).norm();
    up = from_pin_to(centre, drum_);
    up.length += drum_ * wound + std::sqrt(std::max(0.0, (away - drum_) * (away + drum_)));
  }
  // The string enters a sheath straight down from the pin's outer side; its length inside is constant.
  const double normal_into_sheath = hand_ > 0 ? 0.0 : k_pi;
  const double below = sheathed_ ? normal_into_sheath : lower_normal;
  const double wrap = turned_near(hand_ * (up.normal - below), 0.5 * k_pi);
  return rho_ * wrap + up.length;
}

/// Wrap angle of the string on the drum; negative if the string is clear of it. The end's direction and the pin's are
/// counted from straight below O in the winding sense, since at home the string lies on the drum's outer side.
double StringAbove::wound_on_drum(double theta) const {
  const auto counted = [this](double angle) {
    const double mirrored = hand_ > 0 ? angle : k_pi - angle;
    return turned_near(mirrored, 0.5 * k_pi);
  };
  const Vec2 from_centre = end_ - drum_centre_;
  const double tangent =
      counted(direction(from_centre)) - elementary::acos(std::clamp(drum_ / from_centre.norm(), -1.0, 1.0));
  return tangent - counted(from_pin_to(with_link(drum_centre_, theta), drum_).normal) - hand_ * theta;
}

}  // namespace fusee::profile
