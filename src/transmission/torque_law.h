/// \file
/// Internal: α(θ) that lets a motor hold the declared load with the torque that is wanted of it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "fusee/transmission/torque.h"
#include "fusee/transmission/transmission.h"
#include "transmission/table_law.h"

namespace fusee {

/// Virtual work, without friction: M dα = τ dθ, with τ what [load] and [spring] turn the joint with against +θ and M
/// the motor's torque towards +α. So dα/dθ = τ/M, and α is its integral from home:
///
///   dθ/dα = u = M/τ     d²θ/dα² = u u'     d³θ/dα³ = u (u'² + u u'')      (' by θ)
///
/// Integrated by Gauss between the places where M's polynomials meet. A little beyond the range it goes on as declared,
/// further out with the slope that it has there.
struct Transmission::TorqueLaw {
 public:
  explicit TorqueLaw(const Mechanism& mechanism);

  /// Where τ/M is smallest; the law exists where that is positive.
  const TorqueMatch& tightest() const { return tightest_; }
  /// The place next to home where it is not positive.
  std::optional<double> fails_at() const { return fails_at_; }

  double alpha(double theta) const;
  /// θ and its derivatives by α.
  LawValue at(double theta) const;

 private:
  TorqueMatch match(double theta) const;
  double slope(double theta) const;
  double integral(double from, double to) const;
  void look(double theta);
  void set_ends();

  Mechanism mechanism_;  ///< what the law is of: joint, pulley, load, spring
  std::shared_ptr<const TableLaw> wanted_;
  std::vector<double> places_;   ///< θ between which is integrated, home among them
  std::vector<double> alphas_;   ///< there
  double least_ = 0, most_ = 0;  ///< θ between which the law goes on as declared
  TorqueMatch tightest_;
  std::optional<double> fails_at_;
};

}  // namespace fusee
