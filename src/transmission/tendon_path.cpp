#include "fusee/transmission/tendon_path.h"

#include <limits>

namespace fusee {

PinPlace pin_place(const Mechanism& mechanism, Side side, double rho) {
  const Guides& guides = mechanism.guides;
  return {side == Side::right ? guides.ED : guides.EB, guides.OE, mechanism.pulley.EF, rho, mechanism.joint.R};
}

// The line {x : x·n = m} through C = R (sin θ, cos θ) touches the pin's circle on its outer side: (C − P)·n = ρ. With β the direction
// of C − P and D its length, n stands at ψ = β − acos(ρ/D). Differentiating (C − P)·n = ρ with C' = R (cos θ, −sin θ) gives
//
//   m   = R sin(θ + ψ)        f = (C − P)·t = sqrt(D² − ρ²)          a = R cos(θ + ψ)
//   ψ'  = −a/f                f' = −m − ρψ'                          ω = 1 + ψ'
//   m'  = aω                  a' = −mω                               ψ'' = (mω − ψ'f')/f
//   m'' = −mω² + aψ''
//
// and, for the length f + ρψ above a fixed point of the rim, L' = f' + ρψ' = −m: virtual work.
UpperSpan upper_span(const PinPlace& place, double theta) {
  const Vec2 attachment = place.R * Vec2(std::sin(theta), std::cos(theta));
  const Vec2 from_pin = attachment - place.pin();
  const double distance = from_pin.norm();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!(distance > place.rho)) return {nan, nan, nan, nan, nan, nan};

  double beta = std::atan2(from_pin.y(), from_pin.x());
  // C seen from the pin lies anywhere but straight below it: cut the angle there, so that wraps of more than 90° stay continuous.
  if (beta < -0.5 * k_pi) beta += k_two_pi;

  UpperSpan span;
  span.normal = beta - std::acos(place.rho / distance);
  span.free = std::sqrt((distance - place.rho) * (distance + place.rho));
  span.length = span.free + place.rho * span.normal;
  span.m = place.R * std::sin(theta + span.normal);
  const double a = place.R * std::cos(theta + span.normal);
  const double dpsi = -a / span.free;
  const double omega = 1.0 + dpsi;
  const double dfree = -span.m - place.rho * dpsi;
  const double d2psi = (span.m * omega - dpsi * dfree) / span.free;
  span.dm = a * omega;
  span.d2m = -span.m * omega * omega + a * d2psi;
  return span;
}

}  // namespace fusee
