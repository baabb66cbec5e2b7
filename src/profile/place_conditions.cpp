#include "profile/place_conditions.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace fusee::profile {
namespace {

Condition attachment_outside_drum(const Mechanism& mechanism, transmission::Side side) {
  const Joint& joint = mechanism.joint;
  const auto& own = side == transmission::Side::left ? joint.attachment1 : joint.attachment2;
  const std::string tendon = side_digit(side);
  const std::string key = own ? "joint.attachment" + tendon + "_mm" : "joint.length_mm";
  // Tolerates rounding of a place on the drum in the last digits of a double.
  constexpr double rounding = 1e-9;
  Condition condition;
  condition.name = "attachment_outside_drum_" + tendon;
  const Attachment end = own.value_or(Attachment{0, joint.R});
  condition.value =
      elementary::hypot(end.across - joint.drum_centre.across, end.along - joint.drum_centre.along) - joint.drum_radius;
  condition.unit = "mm";
  condition.ok = condition.value >= -rounding * joint.drum_radius;
  if (!condition.ok) {
    condition.message = "tendon " + tendon + " ends " + rounded(-condition.value, 3) + " mm inside the drum (" + key +
                        ", joint.drum_radius_mm)";
  }
  return condition;
}

Condition drum_clear_of_pin(const Mechanism& mechanism, transmission::Side side) {
  const transmission::PinPlace place = transmission::pin_place(mechanism, side, mechanism.seen_pitch_radius());
  Condition condition;
  condition.name = "drum_clear_of_pin_" + pin_name(side);
  condition.value = place.pin().norm() - place.drum_offset - mechanism.joint.drum_radius - mechanism.guides.radius;
  condition.unit = "mm";
  condition.ok = condition.value > 0;
  if (!condition.ok) {
    condition.message = "pin " + pin_name(side) + " lies " + rounded(-condition.value, 3) +
                        " mm inside the drum (joint.drum_radius_mm, guides.radius_mm)";
  }
  return condition;
}

}  // namespace

std::string side_digit(transmission::Side side) { return side == transmission::Side::left ? "1" : "2"; }
std::string pin_name(transmission::Side side) { return side == transmission::Side::left ? "B" : "D"; }

std::vector<Condition> place_conditions(const Mechanism& mechanism) {
  std::vector<Condition> conditions;
  if (!(mechanism.joint.drum_radius > 0)) return conditions;
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    conditions.push_back(attachment_outside_drum(mechanism, side));
    conditions.push_back(drum_clear_of_pin(mechanism, side));
  }
  return conditions;
}

double upper_clearance(const transmission::PinPlace& place, double theta, const Vec2& point) {
  const transmission::UpperSpan span = transmission::upper_span(place, theta);
  const double turned = theta + place.twist;
  const Vec2 end = place.R * Vec2(elementary::sin(turned), elementary::cos(turned)),
             at_pin = place.pin() + place.rho * unit(span.normal);
  if (span.on_drum == 0) return distance_to_segment(point, end, at_pin);
  const Vec2 centre = transmission::drum_centre(place, theta), from_centre = point - centre;
  const double clearance = std::min(distance_to_segment(point, end, centre + place.drum * unit(span.end_normal)),
                                    distance_to_segment(point, centre + place.drum * unit(span.normal), at_pin));
  // The arc on the drum begins at the normal of the span that reaches the pin. It runs counter-clockwise over the angle
  // `on_drum`.
  const double from_begin = elementary::atan2(from_centre.y(), from_centre.x()) - span.normal;
  const double within_turn = from_begin - k_two_pi * std::floor(from_begin / k_two_pi);  // in [0, 2π)
  const bool is_beside_arc = within_turn <= span.on_drum;
  return is_beside_arc ? std::min(clearance, std::abs(from_centre.norm() - place.drum)) : clearance;
}

Vec2 other_pin(const transmission::Transmission& transmission, transmission::Side side) {
  const Vec2 pin =
      transmission.place(side == transmission::Side::left ? transmission::Side::right : transmission::Side::left).pin();
  return {-pin.x(), pin.y()};
}

std::vector<double> lift_offs(const Mechanism& mechanism, const transmission::Transmission& transmission,
                              transmission::Side side) {
  std::vector<double> angles;
  for (const transmission::Side leaving : {transmission::Side::left, transmission::Side::right}) {
    const auto image_theta = transmission::lift_off(transmission.place(leaving));
    if (!image_theta) continue;
    const double theta = transmission::mirror_sign(leaving) * *image_theta;
    if (theta > mechanism.joint.theta_min + k_beside_lift_off && theta < mechanism.joint.theta_max - k_beside_lift_off)
      angles.push_back(transmission::mirror_sign(side) * theta);
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

// At one normal n the point X = h n + h' t moves along the tangent t by the jump of h'.
double straight_length(const TakeOffs& take_offs, double image_theta) {
  return take_offs.at(image_theta + k_beside_lift_off).curve.dh -
         take_offs.at(image_theta - k_beside_lift_off).curve.dh;
}

}  // namespace fusee::profile
