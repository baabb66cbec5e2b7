/// \file
/// The target motion θ(α): tendon paths over pins and sheaths, moment arms, support functions and tensions. Numbers in
/// brackets are the paper's equations.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"

namespace fusee::transmission {

// ---- Path of a tendon above its pin ---------------------------------------------------------------------------------
// The upper half of a tendon: from its attachment over the joint's drum, if any, and over its guide pin. Moment arm,
// lengths and their derivatives in closed form.
//
// One derivation serves both tendons: tendon 1 is the mirror image of tendon 2 (x → −x, θ → −θ, α → −α).

/// left: tendon 1, pin B, pulley P1. right: tendon 2, pin D, pulley P2.
enum class Side { left, right };

/// Name of a side's pulley.
constexpr std::string_view pulley_name(Side side) { return side == Side::left ? "P1" : "P2"; }

/// +1 for the right, −1 for the left: factor between the mechanism's θ, α, x and those of the right-hand image.
constexpr double mirror_sign(Side side) { return side == Side::right ? 1.0 : -1.0; }

/// Last guide before the pulley, in the right-hand image: the pin, or the exit of the sheath. Coordinates relative to
/// the pulley axis. mm.
struct LowerGuide {
  double across = 0;
  double above = 0;
  double rho = 0;  ///< radius to the tendon's centre line; 0 for a point such as a sheath exit

  /// Polar coordinates c and φ of the guide.
  double c() const { return elementary::hypot(across, above); }
  double phi() const { return elementary::atan2(above, across); }
};

/// Geometry of one tendon in its right-hand image. mm.
struct PinPlace {
  double e;          ///< EB or ED: the pin is at (e, −OE)
  double oe;         ///< OE
  double ef;         ///< EF: the pulley axis is at (0, −OE − EF)
  double rho;        ///< ρp: pin radius to the tendon's centre line (0: a point)
  double R;          ///< distance from O to the tendon's end: OC
  double twist = 0;  ///< angle of that end at home, clockwise from OC, rad
  double drum = 0;   ///< ρ0: drum radius to the tendon's centre line, at most R; 0 without drum
  bool at_C = true;  ///< the tendon ends at C
  /// Exit of the sheath between pin and pulley. The tendon then leaves the pin straight down.
  std::optional<LowerGuide> sheath_exit = std::nullopt;
  double in_sheath = 0;    ///< length of tendon between pin and sheath exit
  double drum_offset = 0;  ///< distance from O to the drum's centre, which is fixed to the link
  double drum_twist = 0;   ///< angle of that centre at home, clockwise from OC, rad

  /// Centre of the pin, centre of the pulley, and last guide before the pulley, in the image.
  Vec2 pin() const { return {e, -oe}; }
  Vec2 pulley_axis() const { return {0.0, -oe - ef}; }
  LowerGuide lower() const { return sheath_exit ? *sheath_exit : LowerGuide{e, ef, rho}; }
  /// Outward normal where the tendon leaves the pin, rad: that of its line to the pulley, or into the sheath.
  double off_pin(double lower_normal) const { return sheath_exit ? 0.0 : lower_normal; }
};

/// The geometry of one tendon. `rho`: pin radius to the tendon's centre line. A tendon's end between the drum's surface
/// and its pitch circle is moved onto the pitch circle, where the tendon leaves the drum.
PinPlace pin_place(const Mechanism& mechanism, Side side, double rho);

/// Centre of the drum at joint angle `theta` of the image.
Vec2 drum_centre(const PinPlace& place, double theta);

/// Joint angle of the image above which the tendon is clear of the drum. Null without a drum, and where the pin lies
/// inside the drum.
std::optional<double> lift_off(const PinPlace& place);

/// The span from the tendon's end to its tangent point on the pin, at joint angle `theta` of the right-hand image.
struct UpperSpan {
  double m = 0;       ///< moment arm about O: −dL/dθ, mm [4]
  double dm = 0;      ///< dm/dθ
  double d2m = 0;     ///< d²m/dθ²
  double free = 0;    ///< from the tendon's end to the tangent point, over the drum, mm [2],[3]
  double normal = 0;  ///< direction of the line's outward normal at the pin, rad
  /// `free` + ρp · `normal`: length of the tendon above a fixed point of the pin's rim, plus a constant. mm
  double length = 0;
  double dnormal = 0;      ///< d normal/dθ
  double d2normal = 0;     ///< d² normal/dθ²
  double end_normal = 0;   ///< normal of the line at the tendon's end, rad: differs from `normal` by on_drum
  double on_drum = 0;      ///< wrap angle on the drum, rad
  double behind_drum = 0;  ///< straight part of `free` between drum and tendon end
};

/// All values are NaN where the tendon's end lies inside the pin's circle, or the pin inside the drum.
UpperSpan upper_span(const PinPlace& place, double theta);

// ---- Sloping paths --------------------------------------------------------------------------------------------------
// Length change of tendons wound over several turns, whose paths slope in the third dimension. It is a smooth function
// of α per tendon, and the planar formulas treat it as a change of tendon length.

/// Chebyshev series over an interval, with derivatives.
class ChebyshevSeries {
 public:
  struct Value {
    double d0 = 0, d1 = 0, d2 = 0, d3 = 0;
  };

  /// Interpolates `values` at nodes(low, high, count), in their order. Trailing coefficients below `least` are dropped.
  ChebyshevSeries(double low, double high, const std::vector<double>& values, double least);

  /// Chebyshev nodes of an interval, at which the constructor takes values.
  static std::vector<double> nodes(double low, double high, int count);
  /// Value and derivatives at `x`, which may lie slightly outside the interval.
  Value at(double x) const;

 private:
  double low_, high_;
  std::array<std::vector<double>, 4> coefficients_;  ///< coefficients of the function and of its derivatives
};

/// q(α) of both tendons, mm: L + σ = q + const, where L is the planar length of the free path and σ the length wound on
/// the pulley. Zero for planar tendons.
struct SlopedPaths {
  ChebyshevSeries q1;
  ChebyshevSeries q2;
};

// ---- Friction at guides and in sheaths ------------------------------------------------------------------------------
// Friction of a tendon at its guide (a fixed pin or a turning idler) and in its sheath.

/// Friction of one guide. It bounds the ratio of the tensions on both sides; while the tendon slides, the ratio is at
/// its bound.
struct GuideFriction {
  double mu = 0;  ///< friction coefficient of a pin (capstan)
  /// Idlers: bearing friction coefficient × bearing radius / idler radius to the tendon's centre line.
  double turning = 0;
  bool is_idler = false;

  /// Natural logarithm of the bound on the tension ratio at a wrap angle (rad); 0 where the tendon has left the guide.
  double log_ratio(double wrap) const;
  /// Derivative of log_ratio() by a wrap above 0.
  double slope(double wrap) const;
};

/// The friction of the declared guides.
GuideFriction guide_friction(const Mechanism& mechanism);
/// Friction and compliance of a tendon's sheath. All zero without a sheath.
struct SheathLoad {
  double length = 0;      ///< length of the tendon in the sheath, mm
  double compliance = 0;  ///< axial compliance of the sheath: it shortens and the tendon gains length, mm/N
  double log_ratio = 0;   ///< ln of the bound on the tension ratio: μ × total bend
};

/// The load of the declared sheaths.
SheathLoad sheath_load(const Mechanism& mechanism);
/// A copy of the mechanism without friction at guides and in sheaths.
Mechanism without_friction(Mechanism mechanism);

// ---- Transmission ---------------------------------------------------------------------------------------------------
// θ(α) of the target motion, both moment arms and both pulleys' support functions, with derivatives in closed form.

/// One tendon at one point of the stroke. Derivatives are by α.
struct TendonPoint {
  double m = 0;  ///< moment arm about O, mm
  double p = 0;  ///< moment arm about G, r1 or r2: support function of the pitch curve, mm
  double dp = 0;
  double d2p = 0;
  double upper_normal = 0;  ///< world direction of the outward normal of C–pin, rad
  double lower_normal = 0;  ///< world direction of the outward normal of pin–pulley, rad
  double wrap = 0;          ///< wrap on the pin [8], rad; negative: the tendon has left the pin
  double free_upper = 0;    ///< end to pin, mm
  double lower_reach = 0;   ///< from the foot of G's perpendicular to the pin's tangent point or the sheath exit, mm
  double in_sheath = 0;     ///< length inside the sheath, mm
  /// free_upper + ρp·wrap + in_sheath + lower_reach: down to the foot of the perpendicular, mm
  double length = 0;
};

struct TorqueMatch;  // torque.h

/// The law and both tendons at one point of the stroke. Derivatives are by α.
struct TransmissionPoint {
  double alpha = 0;  ///< rad
  double theta = 0;  ///< rad
  double g = 0;      ///< dθ/dα
  double dg = 0;
  double d2g = 0;
  TendonPoint t1;  ///< left
  TendonPoint t2;  ///< right
};

/// The target motion over its stroke. Cheap to copy; immutable.
///
/// Laws:
/// - compensate: dθ/dα = r1/m1 [4]; α(θ) = (L1(θ) − L1(0))/r1 in closed form.
/// - linear: θ = α/ratio.
/// - table: a quintic spline through the rows.
/// - torque: dθ/dα = M/τ, wanted motor torque per load torque; α(θ) is the integral of τ/M.
/// Every law satisfies virtual work: p_i = m_i dθ/dα.
class Transmission {
 public:
  /// `rho`: pin radius to the tendon's centre line, as the equations see it.
  Transmission(const Mechanism& mechanism, double rho);
  /// Uses the pin radius of the mechanism's method (seen_pitch_radius).
  explicit Transmission(const Mechanism& mechanism);
  /// Includes tendons wound over several turns, whose paths slope: p_i = m_i dθ/dα + dq_i/dα in the tendon's image. A
  /// round P1 turns the joint as if α were α + q1/r1. `paths` null: planar tendons.
  Transmission(const Mechanism& mechanism, std::shared_ptr<const SlopedPaths> paths);
  Transmission(const Transmission&);
  Transmission(Transmission&&) noexcept;
  Transmission& operator=(const Transmission&);
  Transmission& operator=(Transmission&&) noexcept;
  ~Transmission();

  /// The first θ from home at which the law fails: a moment arm vanishes (dead centre), C touches a pin, a wanted
  /// torque does not hold its load, or a formula has no value. Null when the law exists over the whole range. Other
  /// members than alpha() and place() require null.
  std::optional<double> dead_centre() const { return dead_centre_; }

  /// Ends of the range, rad.
  double alpha_min() const { return alpha_min_; }
  double alpha_max() const { return alpha_max_; }
  /// α of a joint angle within the range. The same law extrapolates slightly beyond it.
  double alpha(double theta) const;
  /// Inverse of alpha().
  double theta(double alpha) const;
  /// The point of the stroke at a pulley angle, or at a joint angle, rad. The law extrapolates slightly beyond the
  /// range.
  TransmissionPoint at_alpha(double alpha) const;
  TransmissionPoint at_theta(double theta) const;

  /// Geometry of one tendon.
  const PinPlace& place(Side side) const { return side == Side::left ? left_ : right_; }

 private:
  struct TableLaw;
  struct TorqueLaw;
  friend TorqueMatch tightest_torque(const Mechanism& mechanism);
  friend std::vector<double> wanted_torques(const Mechanism& mechanism, const std::vector<double>& thetas);
  TransmissionPoint at(double alpha, double theta) const;
  double planar_theta(double alpha) const;
  double planar_alpha(double theta) const;
  void find_range();

  Law law_;
  double r1_;
  double ratio_;
  PinPlace left_;
  PinPlace right_;
  std::shared_ptr<const TableLaw> table_;
  std::shared_ptr<const SlopedPaths> paths_;
  std::shared_ptr<const TorqueLaw> torque_;
  double home_length_ = 0;
  std::optional<double> dead_centre_;
  double theta_min_, theta_max_;
  double alpha_min_ = 0, alpha_max_ = 0;
};

// ---- Tensions -------------------------------------------------------------------------------------------------------
// The paper's chain of forces at one point of the stroke: T2 [6], φ [8], T_b [7], Δ [9], Δθ [10],[11].
//
// One tendon carries the load and the other is slack, without pretension. fusee/joint.h has the full model.

/// Forces and elongation by the paper's formulas.
struct PaperForces {
  double gamma1 = 0;      ///< angle at C between OC and tendon 1, rad
  double gamma2 = 0;      ///< angle at C between OC and tendon 2, rad
  double T1 = 0;          ///< tension above pin B, where the load pulls towards +θ, N
  double T2 = 0;          ///< tension above pin D: F_c / sin γ2 [6], N
  double phi = 0;         ///< wrap on pin D [8], rad
  double Tb = 0;          ///< tension of the loaded tendon below its pin: T e^{μφ} [7], N
  double elongation = 0;  ///< elongation of the loaded tendon: Δ = T L/(A E) of both spans [9], mm
  /// Joint rotation under load due to Δ [10],[11], rad; negative where the load pulls towards +θ.
  double theta_error = 0;
  double motor_torque = 0;  ///< torque about G, towards +α: T_b r2, N·mm
  double stiffness = 0;     ///< torsional stiffness implied by [9]-[11]: EA m²/L of the loaded tendon, N·mm/rad
};

/// The load is load_torque(): the tip force as in the paper, or any equivalent torque.
PaperForces paper_forces(const Mechanism& mechanism, const TransmissionPoint& point);

}  // namespace fusee::transmission
