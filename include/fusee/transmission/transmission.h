/// \file
/// θ(α) of the target motion, both moment arms and both pulleys' support functions, with derivatives in closed form.
#pragma once

#include <memory>
#include <optional>

#include "fusee/mechanism/mechanism.h"
#include "fusee/transmission/sloped_paths.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

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

  double alpha_min() const { return alpha_min_; }
  double alpha_max() const { return alpha_max_; }
  /// α of a joint angle within the range. The same law extrapolates slightly beyond it.
  double alpha(double theta) const;
  double theta(double alpha) const;
  TransmissionPoint at_alpha(double alpha) const;
  TransmissionPoint at_theta(double theta) const;

  const PinPlace& place(Side side) const { return side == Side::left ? left_ : right_; }

 private:
  struct TableLaw;
  struct TorqueLaw;
  friend TorqueMatch tightest_torque(const Mechanism& mechanism);
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

}  // namespace fusee
