/// \file
/// Internal: objectives at one point of the stroke, by the paper's equations (transmission/equations.h), for numbers
/// and for intervals with derivatives, so that the proven formulas are the evaluated ones.
#pragma once

#include "fusee/mechanism.h"
#include "fusee/optimize.h"
#include "fusee/transmission.h"
#include "optimize/sharp.h"
#include "optimize/wide_path.h"
#include "transmission/equations.h"

namespace fusee::optimize {

// Unqualified in the formulas, so that other kinds of numbers can have their own.
using transmission::demand_not_negative;
using transmission::direction;
using transmission::hypot;
using transmission::larger;
using transmission::positive_part;
using transmission::sin;

/// Lower bounds of γ of both tendons: below them, a tendon has left its pin. Smaller angles are replaced by the bound,
/// which only affects impossible designs. Functions over a box are then defined and smooth beyond the possible designs
/// too.
struct PinAngles {
  double of_1 = -1e300, of_2 = -1e300;

  bool operator==(const PinAngles&) const = default;
};

/// Numbers of a mechanism that [1]-[11] use.
template <typename S>
struct DesignNumbers {
  S R, EB, ED, OE, EF, r1, ratio, mu;
  S rho;        ///< ρp
  S stiffness;  ///< A E of the tendon, N
  S theta_min, theta_max;
  S to_B, to_D;                                       ///< c: distances of the pins from the pulley's axis, mm
  S angle_B, angle_D;                                 ///< directions of the pins in the right-hand image, rad
  bool linear = false;                                ///< law = linear: θ = α/ratio; else compensate
  S half;                                             ///< half of the tendon's diameter, mm
  PinAngles least;                                    ///< bounds for a box at the evaluated point
  std::optional<WideNumbers<S>> wide = std::nullopt;  ///< set if the joint is not the paper's
};

/// The numbers as in the file, except that angles are in rad.
template <typename S>
struct FileNumbers {
  S R, EB, ED, OE, EF, r1, ratio, mu, radius, diameter, modulus, theta_min, theta_max;
};

FileNumbers<double> file_numbers(const Mechanism& mechanism);

template <typename S>
DesignNumbers<S> design_numbers(const FileNumbers<S>& file, Law law, bool point_pins) {
  DesignNumbers<S> d{file.R,         file.EB,        file.ED, file.OE, file.EF, file.r1, file.ratio, file.mu, 0.0, 0.0,
                     file.theta_min, file.theta_max, 0.0,     0.0,     0.0,     0.0,     false,      0.0,     {}};
  transmission::Domain whole;  // EF > 0
  d.to_B = hypot(d.EB, d.EF);
  d.to_D = hypot(d.ED, d.EF);
  d.angle_B = direction(d.EB, d.EF, whole);
  d.angle_D = direction(d.ED, d.EF, whole);
  if (!point_pins) d.rho = file.radius + 0.5 * file.diameter;
  d.stiffness = stiffness_of_section(file.modulus, file.diameter);
  d.linear = law == Law::linear;
  d.half = 0.5 * file.diameter;
  return d;
}

/// One tendon above its pin.
template <typename S>
struct UpperNumbers {
  S gamma;  ///< angle between OC and the tendon, rad: in its image, the direction of its normal plus θ
  S sine;   ///< sin γ: the moment arm is R sin γ. For other joints than the paper's: arm / R
  S free;   ///< C to the pin, mm
};

/// Both tendons at one point of the stroke.
template <typename S>
struct StrokeNumbers {
  transmission::RotationAngle<S> theta;
  UpperNumbers<S> upper1, upper2;  ///< of both tendons
  S r1, r2;                        ///< mm
  S reach;                         ///< pin D to the foot of G's perpendicular, mm
  S phi;                           ///< wrap on pin D [8]
};

/// The tendon's line above the pin, in the frame of the link; for intervals by sharp.h.
template <typename S>
transmission::UpperLine<S> upper_line_of(const DesignNumbers<S>& d, const S& e,
                                         const transmission::RotationAngle<S>& theta, transmission::Domain& domain) {
  return transmission::upper_line(transmission::offset_from_pin_in_link(d.R, e, d.OE, theta), d.rho, domain);
}
inline transmission::UpperLine<transmission::Jet> upper_line_of(
    const DesignNumbers<transmission::Jet>& d, const transmission::Jet& e,
    const transmission::RotationAngle<transmission::Jet>& theta, transmission::Domain& domain) {
  const SharpLine line = sharp_upper_line(d.R, e, d.OE, d.rho, theta, domain);
  return {line.normal, line.reach};
}
/// The joint's sheaths, if any.
template <typename S>
const SheathNumbers<S>* sheath_of(const DesignNumbers<S>& d) {
  return d.wide && d.wide->sheath ? &*d.wide->sheath : nullptr;
}

/// The line of tendon 1 (left) or 2 from its pin, or its sheath's exit, to a pulley of the radius `p`.
template <typename S>
transmission::LowerLine<S> lower_line_of(const DesignNumbers<S>& d, const S& p, transmission::Side side,
                                         transmission::Domain& domain) {
  if (const auto* sheath = sheath_of(d))
    return transmission::lower_line(p, S(0.0), sheath->to_exit, sheath->angle, domain);
  const bool left = side == transmission::Side::left;
  return transmission::lower_line(p, d.rho, left ? d.to_B : d.to_D, left ? d.angle_B : d.angle_D, domain);
}
inline transmission::LowerLine<transmission::Jet> lower_line_of(const DesignNumbers<transmission::Jet>& d,
                                                                const transmission::Jet& p, transmission::Side side,
                                                                transmission::Domain& domain) {
  const SheathNumbers<transmission::Jet>* sheath = sheath_of(d);
  const SharpLine line = sheath != nullptr
                             ? sharp_lower_line(p, transmission::Jet(0.0), sheath->across, sheath->above, domain)
                             : sharp_lower_line(p, d.rho, side == transmission::Side::left ? d.EB : d.ED, d.EF, domain);
  return {line.normal, line.reach};
}

/// Outward normal where a tendon leaves its pin: that of its line to the pulley, or straight down into a sheath.
template <typename S>
S off_pin(const DesignNumbers<S>& d, const S& lower_normal) {
  return sheath_of(d) != nullptr ? S(0.0) : lower_normal;
}

/// Distance of the radius of P1 (left) or P2 from the limit set by its tendon's pin or sheath exit. mm
template <typename S>
S clear_of_guide(const DesignNumbers<S>& d, const S& radius, transmission::Side side) {
  if (const auto* sheath = sheath_of(d)) return sheath->to_exit - radius;
  return (side == transmission::Side::left ? d.to_B : d.to_D) - (radius - d.rho);
}

/// Numbers of a tendon with a moment arm, of a joint that is not the paper's.
template <typename S>
UpperNumbers<S> wide_upper_numbers(const DesignNumbers<S>& d, const TendonEnd<S>& end, const S& e, const S& theta,
                                   transmission::Domain& domain) {
  domain.whole = domain.whole && d.wide->domain.whole;
  const WidePath<S> path = wide_path(end, d.wide->drum, e, d.OE, d.rho, theta, domain);
  return {path.normal + theta, positive_part(S(path.arm / d.R), domain), path.free};
}

/// Numbers of a tendon with a moment arm.
template <typename S>
UpperNumbers<S> upper_numbers(const DesignNumbers<S>& d, const S& e, const transmission::RotationAngle<S>& theta,
                              double least, transmission::Domain& domain) {
  const transmission::UpperLine<S> line = upper_line_of(d, e, theta, domain);
  const S gamma = larger(line.normal, S(least));
  return {gamma, positive_part(sin(gamma), domain), line.free};
}

template <typename S>
void set_upper_numbers(const DesignNumbers<S>& d, StrokeNumbers<S>& n, transmission::Domain& domain) {
  if constexpr (k_may_be_wide<S>) {
    if (d.wide) {
      n.upper2 = wide_upper_numbers(d, d.wide->end2, d.ED, n.theta.angle, domain);
      n.upper1 = wide_upper_numbers(d, d.wide->end1, d.EB, S(-n.theta.angle), domain);
      return;
    }
  }
  n.upper2 = upper_numbers(d, d.ED, n.theta, d.least.of_2, domain);
  n.upper1 = upper_numbers(d, d.EB, n.theta.mirrored(), d.least.of_1, domain);
}

/// Both tendons above their pins and the radii that follow from their arms, without their lines to the pulley.
template <typename S>
StrokeNumbers<S> upper_stroke(const DesignNumbers<S>& d, const S& place, transmission::Domain& domain) {
  StrokeNumbers<S> n;
  n.theta = transmission::rotation_angle(d.theta_min + place * (d.theta_max - d.theta_min));
  set_upper_numbers(d, n, domain);
  // Arms are in units of R, which cancels: an interval is tighter when each variable occurs less often.
  const S slope = d.linear ? d.R / d.ratio : transmission::slope_over_round_pulley(d.r1, n.upper1.sine);
  n.r1 = d.linear ? transmission::pulley_radius(n.upper1.sine, slope) : d.r1;
  n.r2 = transmission::pulley_radius(n.upper2.sine, slope);
  return n;
}

/// `place`: 0 at the lowest, 1 at the highest joint angle. phi is negative if tendon 2 has left its pin.
template <typename S>
StrokeNumbers<S> stroke_numbers(const DesignNumbers<S>& d, const S& place, transmission::Domain& domain) {
  StrokeNumbers<S> n = upper_stroke(d, place, domain);
  const transmission::LowerLine<S> lower = lower_line_of(d, n.r2, transmission::Side::right, domain);
  n.reach = lower.reach;
  n.phi = n.upper2.gamma - n.theta.angle - off_pin(d, lower.normal);
  return n;
}

/// Wrap of tendon 1 on pin B.
template <typename S>
S wrap_over_B(const DesignNumbers<S>& d, const StrokeNumbers<S>& n, transmission::Domain& domain) {
  return S(n.upper1.gamma + n.theta.angle) -
         off_pin(d, lower_line_of(d, n.r1, transmission::Side::left, domain).normal);
}

/// Area of the rectangle around link, pins and pulley in this pose. mm²
template <typename S>
S footprint_at(const DesignNumbers<S>& d, const StrokeNumbers<S>& n) {
  const S x = d.R * n.theta.sine, y = d.R * n.theta.cosine;
  const S right = larger(larger(d.ED + d.rho, n.r2), x), left = larger(larger(d.EB + d.rho, n.r1), -x);
  const S top = larger(larger(y, d.rho - d.OE), S(0.0));
  const S bottom = larger(larger(d.OE + d.EF + larger(n.r1, n.r2), d.OE + d.rho), S(0.0));
  return (left + right) * (top + bottom);
}

template <typename S>
S below_guide(const DesignNumbers<S>& d, const S& above, const S& wrap) {
  if constexpr (k_may_be_wide<S>) {
    if (d.wide && d.wide->turning) return tension_below_idler(above, *d.wide->turning, wrap);
  }
  return transmission::tension_below_pin(above, d.mu, wrap);
}

/// [9] including the sheath: the tendon in it and the sheath itself yield to the mean of its end tensions.
template <typename S>
S elongation_at(const DesignNumbers<S>& d, const StrokeNumbers<S>& n, const S& above, const S& off_pin) {
  const S on_pin = d.rho * n.phi;
  if (const auto* sheath = sheath_of(d)) {
    const S below = transmission::tension_below_pin(off_pin, sheath->mu, sheath->bend);
    // Length of tendon that yields as much as the sheath and the tendon in it. mm
    const S sheathed = sheath->length + d.stiffness * sheath->compliance;
    return transmission::elongation_of_tendon(above, off_pin, n.upper2.free, on_pin, S(0.0), d.stiffness) +
           transmission::elongation_of_tendon(off_pin, below, S(0.0), sheathed, n.reach, d.stiffness);
  }
  return transmission::elongation_of_tendon(above, off_pin, n.upper2.free, on_pin, n.reach, d.stiffness);
}

/// Contribution of this point to the objective, which is the maximum over the range. Per newton of tip force.
template <typename S>
S objective_of(Objective objective, const DesignNumbers<S>& d, const StrokeNumbers<S>& n) {
  if (objective == Objective::footprint) return footprint_at(d, n);
  // A newton across OC has the torque R, and the arm is R sin γ: R cancels here too.
  const S above = transmission::tension_above_pin(S(1.0), n.upper2.sine);
  const S off_pin = below_guide(d, above, n.phi);
  const auto* sheath = sheath_of(d);
  const S below = sheath != nullptr ? transmission::tension_below_pin(off_pin, sheath->mu, sheath->bend) : off_pin;
  if (objective == Objective::max_tension) return below;
  if (objective == Objective::motor_torque) return below * n.r2;
  const S elongation = elongation_at(d, n, above, off_pin);
  return (180.0 / k_pi) *
         transmission::angle_of_elongation(elongation, S(d.R * n.upper2.sine));  // max_error, in degrees
}

/// Requires both tendons on their pins, since the law θ(α) ends otherwise.
template <typename S>
S objective_at(Objective objective, const DesignNumbers<S>& d, const S& place, transmission::Domain& domain) {
  const StrokeNumbers<S> n = stroke_numbers(d, place, domain);
  demand_not_negative(n.phi, domain);
  demand_not_negative(wrap_over_B(d, n, domain), domain);
  return objective_of(objective, d, n);
}

}  // namespace fusee::optimize
