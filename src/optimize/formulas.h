/// \file
/// Internal: the paper's equations at one place of the stroke, written once for numbers, intervals and intervals with
/// derivatives: what is evaluated and what is proven are the same.
#pragma once

#include "fusee/mechanism/mechanism.h"
#include "fusee/optimize/objectives.h"
#include "optimize/interval.h"

namespace fusee {

/// The numbers of a mechanism that [1]-[11] use.
template <typename S>
struct DesignNumbers {
  S R, EB, ED, OE, EF, r1, ratio, mu;
  S rho;        ///< ρp
  S stiffness;  ///< A E of the tendon, N
  S theta_min, theta_max;
  S to_B, to_D;             ///< c: from the pulley's axis to the pins, mm
  S angle_B, angle_D;       ///< their directions in the right-hand image, rad
  bool linear = false;      ///< law = linear: θ = α/ratio; else compensate
  bool point_pins = false;  ///< ρp = 0: the paper's equations
};

/// The same as they stand in the file, but for angles, which are rad.
template <typename S>
struct FileNumbers {
  S R, EB, ED, OE, EF, r1, ratio, mu, radius, diameter, modulus, theta_min, theta_max;
};

FileNumbers<double> file_numbers(const Mechanism& mechanism);

template <typename S>
DesignNumbers<S> design_numbers(const FileNumbers<S>& file, Law law, bool point_pins) {
  DesignNumbers<S> d{file.R, file.EB, file.ED,        file.OE,        file.EF, file.r1, file.ratio, file.mu,
                     0.0,    0.0,     file.theta_min, file.theta_max, 0.0,     0.0,     0.0,        0.0};
  d.to_B = sqrt(squared(d.EB) + squared(d.EF));
  d.to_D = sqrt(squared(d.ED) + squared(d.EF));
  d.angle_B = 0.5 * k_pi - atan(d.EB / d.EF);
  d.angle_D = 0.5 * k_pi - atan(d.ED / d.EF);
  if (!point_pins) d.rho = file.radius + 0.5 * file.diameter;
  d.stiffness = (0.25 * k_pi) * squared(file.diameter) * file.modulus;
  d.linear = law == Law::linear;
  d.point_pins = point_pins;
  return d;
}

/// One tendon's upper span in its right-hand image.
template <typename S>
struct SpanNumbers {
  S per_force;  ///< R/m = 1/sin γ [6]
  S gamma;      ///< between OC and the tendon, rad
  S free;       ///< C to the pin, mm
};

// In the link's frame the pin lies a = e cos θ + OE sin θ beside OC and b = R + OE cos θ − e sin θ below C, both linear
// in the lengths: tan γ = a/b. Over a pin of radius ρ the line is turned by asin(ρ/D), D² = a² + b².
template <typename S>
SpanNumbers<S> span_numbers(const DesignNumbers<S>& d, const S& e, const S& sine, const S& cosine, Domain& domain) {
  const S a = e * cosine + d.OE * sine;
  const S b = d.R + d.OE * cosine - e * sine;
  if (d.point_pins) {
    const S q = b / positive_part(a, domain);
    return {sqrt(1.0 + squared(q)), 0.5 * k_pi - atan(q), sqrt(squared(a) + squared(b))};
  }
  const S distance = sqrt(positive_part(squared(a) + squared(b), domain));
  const S q = b / positive_part(a, domain);
  const S gamma = 0.5 * k_pi - atan(q) + asin(unit_part(d.rho / distance, domain));
  return {1.0 / positive_part(sin(gamma), domain), gamma,
          sqrt(positive_part(squared(distance) - squared(d.rho), domain))};
}

template <typename S>
struct StrokeNumbers {
  S theta, sine, cosine;
  SpanNumbers<S> upper;  ///< of tendon 2
  S r1, r2;
  S reach;  ///< pin D to the foot of G's perpendicular, mm
  S phi;    ///< wrap over pin D [8]
};

/// Tendon 1 is wanted on its pin too, or the law θ(α) ends. No objective uses its wrap: no derivatives.
template <typename S>
void demand_on_pin_B(const DesignNumbers<S>& d, const S& gamma1, const StrokeNumbers<S>& n, Domain& domain) {
  const auto r1 = value_of(n.r1), rho = value_of(d.rho);
  Domain its_own;
  const auto off = unit_part((d.point_pins ? r1 : r1 - rho) / value_of(d.to_B), its_own);
  domain.possible = domain.possible && its_own.possible;
  demand_not_negative(value_of(gamma1) + value_of(n.theta) - value_of(d.angle_B) + acos(off), domain);
}

/// `place`: 0 at the lowest, 1 at the highest joint angle.
template <typename S>
StrokeNumbers<S> stroke_numbers(const DesignNumbers<S>& d, const S& place, Domain& domain) {
  StrokeNumbers<S> n;
  n.theta = d.theta_min + place * (d.theta_max - d.theta_min);
  n.sine = sin(n.theta);
  n.cosine = cos(n.theta);
  n.upper = span_numbers(d, d.ED, n.sine, n.cosine, domain);
  const SpanNumbers<S> upper1 = span_numbers(d, d.EB, S(-n.sine), n.cosine, domain);
  if (d.linear) {
    n.r1 = d.R / (upper1.per_force * d.ratio);
    n.r2 = d.R / (n.upper.per_force * d.ratio);
  } else {
    n.r1 = d.r1;
    n.r2 = d.r1 * upper1.per_force / n.upper.per_force;  // [4]: r2 = r1 m2/m1
  }
  const S beyond = d.point_pins ? n.r2 : n.r2 - d.rho;
  const S cosine_off = unit_part(beyond / d.to_D, domain);
  n.reach = sqrt(positive_part(squared(d.to_D) - squared(beyond), domain));
  n.phi = n.upper.gamma - n.theta - d.angle_D + acos(cosine_off);
  demand_not_negative(n.phi, domain);
  demand_on_pin_B(d, upper1.gamma, n, domain);
  return n;
}

/// What of the objective this place of the stroke alone would give: the objective is the largest over the range. Per
/// newton of tip force.
template <typename S>
S objective_at(Objective objective, const DesignNumbers<S>& d, const S& place, Domain& domain) {
  const StrokeNumbers<S> n = stroke_numbers(d, place, domain);
  if (objective == Objective::footprint) {
    const S rim = d.point_pins ? S(0.0) : d.rho;
    const S x = d.R * n.sine, y = d.R * n.cosine;
    const S right = larger(larger(d.ED + rim, n.r2), x), left = larger(larger(d.EB + rim, n.r1), -x);
    const S top = larger(larger(y, rim - d.OE), S(0.0));
    const S bottom = larger(larger(d.OE + d.EF + larger(n.r1, n.r2), d.OE + rim), S(0.0));
    return (left + right) * (top + bottom);
  }
  const S below_pin = n.upper.per_force * exp(d.mu * n.phi);  // [7]
  if (objective == Objective::max_tension) return below_pin;
  if (objective == Objective::motor_torque) return below_pin * n.r2;
  // max_error: [9] each span under its own tension, the wrap under the mean of both; [10],[11] Δθ = Δ/m2, in degrees.
  S stretched = n.upper.per_force * n.upper.free + below_pin * n.reach;
  if (!d.point_pins) stretched = stretched + 0.5 * (n.upper.per_force + below_pin) * d.rho * n.phi;
  return (180.0 / k_pi) * stretched * n.upper.per_force / (d.stiffness * d.R);
}

}  // namespace fusee
