#include <algorithm>
#include <cmath>
#include <limits>

#include "fusee/transmission.h"
#include "transmission/equations.h"

namespace fusee::transmission {

namespace {

/// Geometry of a tendon that ends at C, without drum and sheath.
PinPlace plain_pin_place(const Mechanism& mechanism, Side side, double rho) {
  const Guides& guides = mechanism.guides;
  if (side == Side::left) return {guides.EB, guides.OE, mechanism.pulley.EF, rho, mechanism.joint.R};
  return {guides.ED, guides.OE + guides.D_below_B, mechanism.pulley.EF - guides.D_below_B, rho, mechanism.joint.R};
}

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr UpperSpan k_no_span = {k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan};

/// The line that touches drum and pin, both on its inner side. Its distance from the drum's centre E is ρ0, from the
/// pin's centre P it is ρ: (P − E)·n = ρ0 − ρ.
struct DrumLine {
  double normal = 0;  ///< direction of the outward normal, rad
  double length = 0;  ///< from tangent point to tangent point, mm
};

std::optional<DrumLine> drum_line(const PinPlace& place, const Vec2& centre) {
  const Vec2 to_pin = place.pin() - centre;
  const double distance = to_pin.norm();
  const double beyond = place.drum - place.rho;
  if (!(std::abs(beyond) < distance)) return std::nullopt;
  return DrumLine{elementary::atan2(to_pin.y(), to_pin.x()) + elementary::acos(beyond / distance),
                  std::sqrt((distance - beyond) * (distance + beyond))};
}

/// The tendon's end relative to the drum's centre.
struct DrumOffset {
  double away = 0;   ///< distance, mm
  double twist = 0;  ///< direction at home, clockwise from OC, rad
};

DrumOffset end_offset_from_drum(const PinPlace& place) {
  if (place.drum_offset == 0) return {place.R, place.twist};
  const double ahead = place.drum_twist - place.twist;
  // From the drum's centre to the end, in the frame at O whose y axis points to the end.
  const Vec2 offset(-place.drum_offset * elementary::sin(ahead), place.R - place.drum_offset * elementary::cos(ahead));
  return {std::max(place.drum, offset.norm()), place.twist + elementary::atan2(offset.x(), offset.y())};
}

/// Angle between the direction of the tendon's end and the normal of its tangent to the drum.
double opening(const PinPlace& place, const DrumOffset& end) { return elementary::acos(place.drum / end.away); }

/// Wrap angle on the drum, rad; negative: the tendon is clear of the drum.
double wrap_on_drum(const PinPlace& place, const DrumOffset& end, const DrumLine& line, double theta) {
  const double turned = end.twist == 0 ? theta : theta + end.twist;
  return 0.5 * k_pi - turned - opening(place, end) - line.normal;
}

// Tendon on a drum whose centre E moves round O at the distance e, which is PinPlace::drum_offset (not the guide offset
// OE); ε is drum_twist, ψ the direction of n and f the length of the line from drum to pin. (P − E)·n = ρ0 − ρ is the
// free tendon's (C − P)·n = ρ (free_span) with E for C and ρ − ρ0 for ρ. The derivatives of normal and line are
// therefore those of free_span(), with k = e sin(θ + ε + ψ) for the arm:
//
//   m = ρ0 + k      a = e cos(θ + ε + ψ)      ψ' = −a/f      ω = 1 + ψ'      f' = −k − (ρ − ρ0)ψ'
//   m' = aω         ψ'' = (kω − ψ'f')/f       m'' = −kω² + aψ''
//
// The wrap on the drum is π/2 − θ − opening − ψ, so the length satisfies L' = ρ0 (−1 − ψ') + f' + ρψ' = −m. For a drum
// about O, e = 0: the line at the pin stays fixed and the drum winds by the joint rotation.
UpperSpan span_on_drum(const PinPlace& place, const DrumOffset& end, const DrumLine& line, double wrap, double theta) {
  UpperSpan span;
  span.m = place.drum;
  span.normal = line.normal;
  span.on_drum = wrap;
  span.end_normal = line.normal + wrap;
  span.behind_drum = std::sqrt((end.away - place.drum) * (end.away + place.drum));
  span.free = span.behind_drum + place.drum * wrap + line.length;
  span.length = span.free + place.rho * span.normal;
  if (place.drum_offset == 0) return span;
  const double direction = theta + place.drum_twist + line.normal;
  const double arm = place.drum_offset * elementary::sin(direction), a = place.drum_offset * elementary::cos(direction);
  const double omega = 1.0 - a / line.length;
  const double dlength = -arm - (place.rho - place.drum) * (omega - 1.0);
  span.dnormal = omega - 1.0;
  span.d2normal = (arm * omega - span.dnormal * dlength) / line.length;
  span.m += arm;
  span.dm = a * omega;
  span.d2m = -arm * omega * omega + a * span.d2normal;
  return span;
}

UpperSpan free_span(const PinPlace& place, double theta);

/// Moves an end inside an eccentric drum onto the drum's pitch circle.
void keep_out_of_drum(PinPlace& place) {
  const Vec2 centre = drum_centre(place, 0.0);
  const Vec2 end = place.R * Vec2(elementary::sin(place.twist), elementary::cos(place.twist));
  const Vec2 away = end - centre;
  if (away.norm() >= place.drum) return;
  const Vec2 out = centre + place.drum * away.normalized();
  place.R = out.norm();
  place.twist += elementary::atan2(cross(out, end), out.dot(end));  // clockwise
}

}  // namespace

PinPlace pin_place(const Mechanism& mechanism, Side side, double rho) {
  const Joint& joint = mechanism.joint;
  PinPlace place = plain_pin_place(mechanism, side, rho);
  if (const Sheath& sheath = mechanism.sheath; sheath.is_there()) {
    place.sheath_exit = LowerGuide{sheath.exit_across, sheath.exit_above, 0};
    place.in_sheath = sheath.length;
  }
  if (joint.is_plain()) return place;
  place.drum = mechanism.drum_pitch_radius();
  if (const auto& attachment = side == Side::left ? joint.attachment1 : joint.attachment2) {
    const double x = mirror_sign(side) * attachment->across;
    place.at_C = false;
    place.R = elementary::hypot(x, attachment->along);
    // An end straight below O is reached over the drum's outer side, from the right.
    place.twist = x == 0 && attachment->along < 0 ? k_pi : elementary::atan2(x, attachment->along);
  }
  if (joint.drum_centre == Attachment{}) place.R = std::max(place.R, place.drum);
  if (const Attachment& centre = joint.drum_centre; place.drum > 0 && centre != Attachment{}) {
    const double x = mirror_sign(side) * centre.across;
    place.drum_offset = elementary::hypot(x, centre.along);
    place.drum_twist = elementary::atan2(x, centre.along);
    keep_out_of_drum(place);
  }
  return place;
}

Vec2 drum_centre(const PinPlace& place, double theta) {
  if (place.drum_offset == 0) return Vec2(0.0, 0.0);
  const double turned = theta + place.drum_twist;
  return place.drum_offset * Vec2(elementary::sin(turned), elementary::cos(turned));
}

std::optional<double> lift_off(const PinPlace& place) {
  if (!(place.drum > 0)) return std::nullopt;
  const DrumOffset end = end_offset_from_drum(place);
  const auto home = drum_line(place, drum_centre(place, 0.0));
  if (!home) return std::nullopt;
  double theta = 0.5 * k_pi - opening(place, end) - home->normal - end.twist;
  // On an eccentric drum the line turns a little too: the wrap falls with θ at the rate 1 + ψ' ≈ 1, so the iteration
  // converges fast.
  for (int i = 0; i < 60 && place.drum_offset != 0; ++i) {
    const auto line = drum_line(place, drum_centre(place, theta));
    if (!line) return std::nullopt;
    const double wrap = wrap_on_drum(place, end, *line, theta);
    theta += wrap;
    if (std::abs(wrap) < 1e-14) break;
  }
  return theta;
}

// With a drum, the direction of the end from the drum's centre is π/2 − θ − τ, where τ is the end's twist. The normal
// of the tangent from the end to the drum lies opening() before that direction. Where that normal is beyond the normal
// of the line from drum to pin, the tendon lies on the drum in between.
UpperSpan upper_span(const PinPlace& place, double theta) {
  const double turned = place.twist == 0 ? theta : theta + place.twist;
  if (!(place.drum > 0)) return free_span(place, turned);
  const auto line = drum_line(place, drum_centre(place, theta));
  if (!line) return k_no_span;
  const DrumOffset end = end_offset_from_drum(place);
  const double wrap = wrap_on_drum(place, end, *line, theta);
  return wrap >= 0 ? span_on_drum(place, end, *line, wrap, theta) : free_span(place, turned);
}

namespace {

// Differentiating (C − P)·n = ρ (upper_line) with C = R (sin θ, cos θ), C' = R (cos θ, −sin θ). ψ is the direction of
// n, t is n turned by +90°, D is |C − P| and f the free length:
//
//   m   = R sin(θ + ψ)        f = (C − P)·t = sqrt(D² − ρ²)          a = R cos(θ + ψ)
//   ψ'  = −a/f                f' = −m − ρψ'                          ω = 1 + ψ'
//   m'  = aω                  a' = −mω                               ψ'' = (mω − ψ'f')/f
//   m'' = −mω² + aψ''
//
// The length f + ρψ above a fixed point of the rim satisfies L' = f' + ρψ' = −m: virtual work.
UpperSpan free_span(const PinPlace& place, double theta) {
  Domain domain;
  const UpperLine<double> line =
      upper_line(offset_from_pin(place.R, place.e, place.oe, rotation_angle(theta)), place.rho, domain);
  if (!domain.possible) return k_no_span;

  UpperSpan span;
  span.normal = line.normal;
  // The normal lies less than a quarter turn from the end's direction when the arm is positive. This selects the turn
  // for ends that come round from the other side.
  if (place.twist != 0 || place.drum > 0)
    span.normal += k_two_pi * std::round((0.5 * k_pi - theta - span.normal) / k_two_pi);
  span.free = line.free;
  span.length = span.free + place.rho * span.normal;
  span.m = place.R * elementary::sin(theta + span.normal);
  const double a = place.R * elementary::cos(theta + span.normal);
  const double dpsi = -a / span.free;
  const double omega = 1.0 + dpsi;
  const double dfree = -span.m - place.rho * dpsi;
  const double d2psi = (span.m * omega - dpsi * dfree) / span.free;
  span.dm = a * omega;
  span.d2m = -span.m * omega * omega + a * d2psi;
  span.dnormal = dpsi;
  span.d2normal = d2psi;
  span.end_normal = span.normal;
  return span;
}

}  // namespace

}  // namespace fusee::transmission
