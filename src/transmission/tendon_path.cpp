#include "fusee/transmission/tendon_path.h"

#include <limits>

#include "transmission/equations.h"

namespace fusee {

PinPlace pin_place(const Mechanism& mechanism, Side side, double rho) {
  const Guides& guides = mechanism.guides;
  if (side == Side::left) return {guides.EB, guides.OE, mechanism.pulley.EF, rho, mechanism.joint.R};
  return {guides.ED, guides.OE + guides.D_below_B, mechanism.pulley.EF - guides.D_below_B, rho, mechanism.joint.R};
}

// Differentiating (C − P)·n = ρ (upper_line) with C = R (sin θ, cos θ), C' = R (cos θ, −sin θ) gives, with ψ the
// direction of n and f the free length,
//
//   m   = R sin(θ + ψ)        f = (C − P)·t = sqrt(D² − ρ²)          a = R cos(θ + ψ)
//   ψ'  = −a/f                f' = −m − ρψ'                          ω = 1 + ψ'
//   m'  = aω                  a' = −mω                               ψ'' = (mω − ψ'f')/f
//   m'' = −mω² + aψ''
//
// and, for the length f + ρψ above a fixed point of the rim, L' = f' + ρψ' = −m: virtual work.
UpperSpan upper_span(const PinPlace& place, double theta) {
  Domain domain;
  const UpperLine<double> line = upper_line(from_pin(place.R, place.e, place.oe, turned_by(theta)), place.rho, domain);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!domain.possible) return {nan, nan, nan, nan, nan, nan};

  UpperSpan span;
  span.normal = line.normal;
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
  return span;
}

}  // namespace fusee
