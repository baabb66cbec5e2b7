/// \file
/// Internal: θ(α) as a file declares it, whether by tendons or by a ratio.
#pragma once

#include <optional>

#include "fusee/transmission/transmission.h"

namespace fusee {

class DeclaredLaw {
 public:
  explicit DeclaredLaw(const Mechanism& declared);

  /// False where the law of the tendons does not exist over the range: then nothing else may be asked but slope().
  bool exists() const { return !law_ || !law_->dead_centre(); }
  /// Of a ratio the zero is free.
  bool has_zero() const { return law_.has_value(); }
  /// dθ/dα from end to end; 0 where the law does not exist.
  double slope() const { return slope_; }
  /// rad; 0 for a ratio, which has no range.
  double alpha_range() const { return law_ ? law_->alpha_max() - law_->alpha_min() : 0; }
  /// Whether most of a run may lie there.
  bool reaches(double alpha) const;

  /// Beyond the range the law itself goes on …
  double theta(double alpha) const { return law_ ? law_->theta(alpha) : alpha / ratio_; }
  /// … or its mean slope, however far.
  double theta_straight_on(double alpha) const;

 private:
  double ratio_ = 1;
  double slope_ = 0;
  std::optional<Transmission> law_;
};

}  // namespace fusee
