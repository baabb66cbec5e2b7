/// \file
/// Internal: the upper path of a tendon of a joint that is not the paper's, from a separate attachment and possibly
/// over a drum on the joint. For numbers and for intervals with derivatives; equivalent to upper_span() of
/// fusee/transmission.h, which has the derivation.
///
/// In the frame of a tendon's end (the link's frame rotated by the end's twist τ) an attachment is a lever point. The
/// equations and enclosures for C apply to it, with its distance from O for R and θ + τ for θ. On the drum the line to
/// the pin is fixed, and the arm is ρ0. In a box that contains the lift-off both branches are joined: arm, direction
/// and length are continuous there, and their slopes are those of one branch or the other, so that the mean value
/// theorem holds.
#pragma once

#include <optional>
#include <type_traits>

#include "fusee/mechanism.h"
#include "optimize/sharp.h"

namespace fusee::optimize {

// The formulas call these functions unqualified: each scalar type may have its own overload.
using transmission::direction;
using transmission::hypot;
using transmission::larger;
using transmission::sin;

/// Only these scalar types support other joints than the paper's.
template <typename S>
constexpr bool k_may_be_wide = std::is_same_v<S, double> || std::is_same_v<S, transmission::Jet>;

/// Features of a mechanism that the paper's joint lacks.
struct WideKind {
  bool drum = false;
  bool own1 = false, own2 = false;  ///< tendon 1 or 2 has an attachment of its own
  bool idlers = false, sheath = false;
  bool sheath_is_compliant = false;

  bool is_papers() const { return !drum && !own1 && !own2 && !idlers && !sheath; }
};

WideKind wide_kind(const Mechanism& mechanism);

/// The keys of these features, in mm and rad.
template <typename S>
struct WideFileNumbers {
  S drum_radius, across1, along1, across2, along2, bearing_radius, bearing_friction;
  S sheath_length, sheath_bend, sheath_mu, sheath_stiffness, exit_across, exit_above;
};

WideFileNumbers<double> wide_file_numbers(const Mechanism& mechanism);

/// A tendon's end in its right-hand image.
template <typename S>
struct TendonEnd {
  S away;                   ///< distance from O, mm
  S twist;                  ///< angle at home, clockwise from OC, rad
  bool is_on_drum = false;  ///< true if it lies on the drum's pitch circle in the whole box
};

/// The sheath of each tendon. It begins straight below the pin and ends at a point beside the motor.
template <typename S>
struct SheathNumbers {
  S length, bend, mu;
  S compliance;     ///< mm/N
  S across, above;  ///< exit, relative to the pulley's axis
  S to_exit;        ///< c, mm
  S angle;          ///< φ, rad
};

/// Numbers of a mechanism that the paper's joint lacks.
template <typename S>
struct WideNumbers {
  TendonEnd<S> end1, end2;
  std::optional<S> drum;  ///< ρ0: drum radius to the tendon's centre line
  /// Idlers only: bearing friction × bearing radius / radius of the tendon's centre line on the idler.
  std::optional<S> turning;
  std::optional<SheathNumbers<S>> sheath;
  transmission::Domain domain;  ///< of the ends
};

/// Angle clockwise from straight up, within ±180°.
double twist_of(double across, double along, transmission::Domain& domain);
transmission::Jet twist_of(const transmission::Jet& across, const transmission::Jet& along,
                           transmission::Domain& domain);

/// True if a <= b in the whole box.
inline bool is_at_most(double a, double b) { return a <= b; }
inline bool is_at_most(const transmission::Jet& a, const transmission::Jet& b) {
  return a.value.upper() <= b.value.lower();
}

/// An end within the drum's pitch circle is moved onto it.
template <typename S>
TendonEnd<S> tendon_end(const S& away, const S& twist, const std::optional<S>& drum) {
  if (!drum) return {away, twist};
  if (is_at_most(away, *drum)) return {*drum, twist, true};
  return {larger(away, *drum), twist};
}

template <typename S>
SheathNumbers<S> sheath_numbers(const WideKind& kind, const WideFileNumbers<S>& file) {
  const S& across = file.exit_across;
  const S& above = file.exit_above;
  transmission::Domain whole;  // above > 0
  return {file.sheath_length,
          file.sheath_bend,
          file.sheath_mu,
          kind.sheath_is_compliant ? S(1.0 / file.sheath_stiffness) : S(0.0),
          across,
          above,
          hypot(across, above),
          direction(across, above, whole)};
}

template <typename S>
WideNumbers<S> wide_numbers(const WideKind& kind, const WideFileNumbers<S>& file, const S& R, const S& diameter,
                            const S& rho) {
  WideNumbers<S> wide;
  if (kind.drum) wide.drum = S(file.drum_radius + 0.5 * diameter);
  const auto own = [&](const S& across, const S& along) {
    return tendon_end(S(hypot(across, along)), twist_of(across, along, wide.domain), wide.drum);
  };
  const TendonEnd<S> C = tendon_end(R, S(0.0), wide.drum);
  // Tendon 1 is mirrored.
  wide.end1 = kind.own1 ? own(-file.across1, file.along1) : C;
  wide.end2 = kind.own2 ? own(file.across2, file.along2) : C;
  if (kind.idlers) wide.turning = S(file.bearing_friction * file.bearing_radius / rho);
  if (kind.sheath) wide.sheath = sheath_numbers(kind, file);
  return wide;
}

/// A tendon above its pin, in its right-hand image.
template <typename S>
struct WidePath {
  S normal;  ///< direction of the line's outward normal at the pin, rad
  S arm;     ///< moment arm about O, mm
  S free;    ///< from the end to the pin's tangent point, over the drum, mm
};

/// Path over the pin at (e, −oe) with the radius `rho`, at joint angle `theta` of the image.
WidePath<double> wide_path(const TendonEnd<double>& end, const std::optional<double>& drum, double e, double oe,
                           double rho, double theta, transmission::Domain& domain);
/// Call only while a RoundingUp exists.
WidePath<transmission::Jet> wide_path(const TendonEnd<transmission::Jet>& end,
                                      const std::optional<transmission::Jet>& drum, const transmission::Jet& e,
                                      const transmission::Jet& oe, const transmission::Jet& rho,
                                      const transmission::Jet& theta, transmission::Domain& domain);

/// [7] for a bearing: (T2 − T1) ρ = μb rb (T1 + T2) sin(φ/2), as in transmission/guide_friction.cpp.
template <typename S>
S tension_below_idler(const S& above, const S& turning, const S& wrap) {
  const S epsilon = turning * sin(S(0.5 * larger(wrap, S(0.0))));
  return above * ((1.0 + epsilon) / (1.0 - epsilon));
}

}  // namespace fusee::optimize
