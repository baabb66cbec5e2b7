/// \file
/// θ(α) of the declared law, both moment arms and both pulleys' support functions, with derivatives in closed form.
#pragma once

#include <memory>
#include <optional>

#include "fusee/mechanism/mechanism.h"
#include "fusee/transmission/sloped_paths.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

/// One tendon at one place of the stroke. Derivatives are with respect to α.
struct TendonPoint {
  double m = 0;  ///< moment arm about O, mm
  double p = 0;  ///< moment arm about G = support of the pitch curve: r1 or r2, mm
  double dp = 0;
  double d2p = 0;
  double upper_normal = 0;  ///< world direction of the outward normal of C–pin, rad
  double lower_normal = 0;  ///< world direction of the outward normal of pin–pulley, rad
  double wrap = 0;          ///< turning over the pin [8], rad; negative: the tendon has left the pin
  double free_upper = 0;    ///< C to pin, mm
  double lower_reach = 0;   ///< from the foot of G's perpendicular to the pin's tangent point or the mouth, mm
  double in_sheath = 0;     ///< what lies in a sheath, mm
  double length = 0;        ///< free_upper + ρp·wrap + in_sheath + lower_reach: to the foot of the perpendicular, mm
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

/// The declared law over its stroke. Cheap to copy; immutable.
///
/// compensate: dθ/dα = r1/m1 [4]; α(θ) = (L1(θ) − L1(0))/r1 in closed form.  linear: θ = α/ratio.
/// table: a quintic spline through the rows.
/// torque: dθ/dα = M/τ, the wanted torque of the motor per that of the load; α(θ) is its integral.  In every law p_i =
/// m_i dθ/dα: virtual work.
class Transmission {
 public:
  /// `rho`: the pin radius to the centre line that the equations see.
  Transmission(const Mechanism& mechanism, double rho);
  /// With the pins as the mechanism's method sees them (seen_pitch_radius).
  explicit Transmission(const Mechanism& mechanism);
  /// With tendons wound several times, whose paths slope: p_i = m_i dθ/dα + dq_i/dα in the tendon's image, and a round
  /// P1 turns the joint as if α were α + q1/r1. `paths` null: planar tendons.
  Transmission(const Mechanism& mechanism, std::shared_ptr<const SlopedPaths> paths);
  Transmission(const Transmission&);
  Transmission(Transmission&&) noexcept;
  Transmission& operator=(const Transmission&);
  Transmission& operator=(Transmission&&) noexcept;
  ~Transmission();

  /// θ where a moment arm of the range vanishes (dead centre), C touches a pin, a wanted torque does not hold its load,
  /// or a formula has no value; null when
  /// the law exists over the whole range. The other members, but alpha() and place(), may be called only when it is
  /// null.
  std::optional<double> dead_centre() const { return dead_centre_; }

  double alpha_min() const { return alpha_min_; }
  double alpha_max() const { return alpha_max_; }
  /// α of a joint angle within the range (a little beyond it is extrapolated by the same law).
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
