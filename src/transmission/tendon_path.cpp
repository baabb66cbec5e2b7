#include "fusee/transmission/tendon_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "transmission/equations.h"

namespace fusee {

namespace {

PinPlace seen_from_C(const Mechanism& mechanism, Side side, double rho) {
  const Guides& guides = mechanism.guides;
  if (side == Side::left) return {guides.EB, guides.OE, mechanism.pulley.EF, rho, mechanism.joint.R};
  return {guides.ED, guides.OE + guides.D_below_B, mechanism.pulley.EF - guides.D_below_B, rho, mechanism.joint.R};
}

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr UpperSpan k_no_span = {k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan};

/// The line that touches drum and pin, both on its inner side: it passes O at ρ0 and the pin's centre at ρ, so that
/// P·n = ρ0 − ρ, and going up it meets the pin first.
struct DrumLine {
  double normal = 0;
  double length = 0;  ///< from tangent point to tangent point
};

std::optional<DrumLine> drum_line(const PinPlace& place) {
  const double to_pin = place.pin().norm();
  const double beyond = place.drum - place.rho;
  if (!(std::abs(beyond) < to_pin)) return std::nullopt;
  return DrumLine{std::atan2(-place.oe, place.e) + std::acos(beyond / to_pin),
                  std::sqrt((to_pin - beyond) * (to_pin + beyond))};
}

/// How far the tendon's end stands behind the normal of the tangent from it to the drum.
double opening(const PinPlace& place) { return std::acos(place.drum / place.R); }

/// Over the drum: the line at the pin stands still, and what the joint turns by, the drum winds.
UpperSpan span_on_drum(const PinPlace& place, const DrumLine& line, double wound) {
  UpperSpan span;
  span.m = place.drum;
  span.normal = line.normal;
  span.on_drum = wound;
  span.end_normal = line.normal + wound;
  span.free = std::sqrt((place.R - place.drum) * (place.R + place.drum)) + place.drum * wound + line.length;
  span.length = span.free + place.rho * span.normal;
  return span;
}

UpperSpan free_span(const PinPlace& place, double theta);

}  // namespace

PinPlace pin_place(const Mechanism& mechanism, Side side, double rho) {
  const Joint& joint = mechanism.joint;
  PinPlace place = seen_from_C(mechanism, side, rho);
  if (const Sheath& sheath = mechanism.sheath; sheath.is_there()) {
    place.mouth = LowerGuide{sheath.exit_across, sheath.exit_above, 0};
    place.in_sheath = sheath.length;
  }
  if (joint.is_plain()) return place;
  place.drum = mechanism.drum_pitch_radius();
  if (const auto& own = side == Side::left ? joint.attachment1 : joint.attachment2) {
    const double x = mirror_sign(side) * own->across;
    place.at_C = false;
    place.R = std::hypot(x, own->along);
    // Straight below O it is reached over the drum's outer side, from the right.
    place.twist = x == 0 && own->along < 0 ? k_pi : std::atan2(x, own->along);
  }
  place.R = std::max(place.R, place.drum);
  return place;
}

std::optional<double> lift_off(const PinPlace& place) {
  if (!(place.drum > 0)) return std::nullopt;
  const auto line = drum_line(place);
  if (!line) return std::nullopt;
  return 0.5 * k_pi - opening(place) - line->normal - place.twist;
}

// With a drum, the end's direction is π/2 − θ − τ, and the tangent from it to the drum has its normal an opening of
// acos(ρ0/R) before that. Where this is further round than the line from drum to pin, what is between lies on the drum.
UpperSpan upper_span(const PinPlace& place, double theta) {
  const double turned = place.twist == 0 ? theta : theta + place.twist;
  if (!(place.drum > 0)) return free_span(place, turned);
  const auto line = drum_line(place);
  if (!line) return k_no_span;
  const double wound = 0.5 * k_pi - turned - opening(place) - line->normal;
  return wound >= 0 ? span_on_drum(place, *line, wound) : free_span(place, turned);
}

namespace {

// Differentiating (C − P)·n = ρ (upper_line) with C = R (sin θ, cos θ), C' = R (cos θ, −sin θ) gives, with ψ the
// direction of n and f the free length,
//
//   m   = R sin(θ + ψ)        f = (C − P)·t = sqrt(D² − ρ²)          a = R cos(θ + ψ)
//   ψ'  = −a/f                f' = −m − ρψ'                          ω = 1 + ψ'
//   m'  = aω                  a' = −mω                               ψ'' = (mω − ψ'f')/f
//   m'' = −mω² + aψ''
//
// and, for the length f + ρψ above a fixed point of the rim, L' = f' + ρψ' = −m: virtual work.
UpperSpan free_span(const PinPlace& place, double theta) {
  Domain domain;
  const UpperLine<double> line = upper_line(from_pin(place.R, place.e, place.oe, turned_by(theta)), place.rho, domain);
  if (!domain.possible) return k_no_span;

  UpperSpan span;
  span.normal = line.normal;
  // The normal of a line with an arm is less than a quarter turn from the direction of its end: where ends come round
  // from the other side, that says which turn is meant.
  if (place.twist != 0 || place.drum > 0)
    span.normal += k_two_pi * std::round((0.5 * k_pi - theta - span.normal) / k_two_pi);
  span.free = line.free;
  span.length = span.free + place.rho * span.normal;
  span.m = place.R * std::sin(theta + span.normal);
  const double a = place.R * std::cos(theta + span.normal);
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

}  // namespace fusee
