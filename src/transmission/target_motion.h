/// \file
/// Internal: the θ(α) that a file declares, by tendons or by a ratio.
#pragma once

#include <optional>

#include "fusee/transmission.h"

namespace fusee::transmission {

class TargetMotion {
 public:
  explicit TargetMotion(const Mechanism& declared);

  /// False when the tendons' law does not exist over the range. Then only slope() may be called.
  bool exists() const { return !law_ || !law_->dead_centre(); }
  /// True when the zero of α is defined; a ratio leaves it free.
  bool has_zero() const { return law_.has_value(); }
  /// Mean dθ/dα over the range; 0 where the law does not exist.
  double slope() const { return slope_; }
  /// Range of α, rad; 0 for a ratio, which has no range.
  double alpha_range() const { return law_ ? law_->alpha_max() - law_->alpha_min() : 0; }
  /// True when α lies in the range or within 10 % of its width outside.
  bool reaches(double alpha) const;

  /// θ(α). Beyond the range by the law's own equations, which hold only near it: see reaches().
  double theta(double alpha) const { return law_ ? law_->theta(alpha) : alpha / ratio_; }
  /// θ(α), extrapolated with the mean slope, however far.
  double theta_extrapolated(double alpha) const;

 private:
  double ratio_ = 1;
  double slope_ = 0;
  std::optional<Transmission> law_;
};

}  // namespace fusee::transmission
