/// \file
/// Internal: α(θ) at which a motor holds the declared load with the wanted torque.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "fusee/transmission.h"
#include "transmission/table_law.h"
#include "transmission/torque.h"

namespace fusee::transmission {

/// Virtual work without friction: M dα = τ dθ, where τ is the torque of [load] and [spring] against +θ and M the motor
/// torque towards +α. Therefore dα/dθ = τ/M, and α is its integral from home:
///
///   dθ/dα = u = M/τ     d²θ/dα² = u u'     d³θ/dα³ = u (u'² + u u'')      (' by θ)
///
/// Gauss quadrature integrates between the breaks of M's polynomials. Slightly beyond the range the law
/// continues, further out with constant slope.
struct Transmission::TorqueLaw {
 public:
  explicit TorqueLaw(const Mechanism& mechanism);

  /// The angle where τ/M is smallest. The law exists if τ/M is positive there.
  const TorqueMatch& tightest() const { return tightest_; }
  /// The angle nearest to home where τ/M is not positive.
  std::optional<double> fails_at() const { return fails_at_; }

  /// The wanted motor torque, N·mm.
  double wanted(double theta) const;
  double alpha(double theta) const;
  /// θ and its derivatives by α.
  LawValue at(double theta) const;

 private:
  TorqueMatch match(double theta) const;
  double slope(double theta) const;
  double integral(double from, double to) const;
  void examine(double theta);
  void set_ends();

  Mechanism mechanism_;                         ///< defines the law: joint, pulley, load, spring
  std::shared_ptr<const TableLaw> wanted_;      ///< wanted motor torque over θ; null: constant
  std::vector<double> places_;                  ///< breaks of the quadrature in θ, home included
  std::vector<double> alphas_;                  ///< α at these places
  double extended_min_ = 0, extended_max_ = 0;  ///< θ range within which the law continues
  TorqueMatch tightest_;
  std::optional<double> fails_at_;
};

}  // namespace fusee::transmission
