#include "transmission/target_motion.h"

#include <algorithm>

namespace fusee::transmission {

TargetMotion::TargetMotion(const Mechanism& declared) {
  if (declared.transmission) {
    ratio_ = declared.transmission->ratio;
    slope_ = 1.0 / ratio_;
    return;
  }
  law_.emplace(declared);
  if (exists()) slope_ = (declared.joint.theta_max - declared.joint.theta_min) / alpha_range();
}

bool TargetMotion::reaches(double alpha) const {
  if (!law_) return true;
  const double margin = 0.1 * alpha_range();
  return alpha > law_->alpha_min() - margin && alpha < law_->alpha_max() + margin;
}

double TargetMotion::theta_extrapolated(double alpha) const {
  if (!law_) return slope_ * alpha;
  const double within = std::clamp(alpha, law_->alpha_min(), law_->alpha_max());
  return law_->theta(within) + slope_ * (alpha - within);
}

}  // namespace fusee::transmission
