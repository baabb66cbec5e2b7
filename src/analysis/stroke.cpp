#include <algorithm>
#include <cmath>

#include "fusee/analysis.h"

namespace fusee::analysis {
namespace {

/// Maximum step as a fraction of the range: within one step, tensions change linearly.
constexpr double k_max_step = 1.0 / 180;
/// Cycles in which the joint settles, before the recorded one.
constexpr int k_settling_cycles = 2;

/// Moves a joint under its declared load.
class StrokeRunner {
 public:
  explicit StrokeRunner(const Mechanism& mechanism) : motion_(joint::joint_model(mechanism)), load_(mechanism.load) {}

  /// Proceeds to `alpha` in steps of at most `longest`. rad
  joint::EquilibriumPoint run_to(double alpha, double longest) {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(alpha - alpha_) / longest)));
    joint::EquilibriumPoint point;
    for (int i = 1; i <= steps; ++i) {
      point = motion_.to({alpha_ + (alpha - alpha_) * i / steps, load_.tip_force, load_.torque});
    }
    alpha_ = alpha;
    return point;
  }

 private:
  joint::JointMotion motion_;
  Load load_;
  double alpha_ = 0;
};

}  // namespace

std::vector<StrokePoint> settled_stroke(const Mechanism& mechanism, const std::vector<double>& alphas) {
  StrokeRunner runner(mechanism);
  const double longest = (alphas.back() - alphas.front()) * k_max_step;
  for (int cycle = 0; cycle < k_settling_cycles; ++cycle) {
    runner.run_to(alphas.back(), longest);
    runner.run_to(alphas.front(), longest);
  }
  std::vector<StrokePoint> points(alphas.size());
  for (std::size_t i = 0; i < alphas.size(); ++i) points[i].rising = runner.run_to(alphas[i], longest);
  for (std::size_t i = alphas.size(); i-- > 0;) points[i].falling = runner.run_to(alphas[i], longest);
  // At the ends both directions share the point before the reversal.
  points.back().falling = points.back().rising;
  points.front().rising = points.front().falling;
  return points;
}

}  // namespace fusee::analysis
