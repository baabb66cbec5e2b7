#include "calibration/held_out.h"

#include <algorithm>
#include <limits>

#include "calibration/fit.h"

namespace fusee {
namespace {

/// Of what all blocks know of a direction, what must be left without a fold for the fold to be held out (commit
/// 7732596: of a delay beside play only the one fast run knows).
constexpr double k_least_known = 0.03;

/// Whether the blocks outside a fold say enough of every direction that all of them together know: a level that alone
/// carries what is known of a number cannot be held out.
bool can_do_without(const Eigen::MatrixXd& rest, const Eigen::MatrixXd& all) {
  if (all.rows() == 0) return true;
  const Eigen::VectorXd size = all.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = size.asDiagonal() * all * size.asDiagonal();
  const Eigen::MatrixXd part = size.asDiagonal() * rest * size.asDiagonal();
  const Eigen::MatrixXd ridge = 1e-9 * Eigen::MatrixXd::Identity(all.rows(), all.cols());
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> shares(part + ridge, scaled + ridge,
                                                                         Eigen::EigenvaluesOnly);
  return shares.eigenvalues().minCoeff() > k_least_known;
}

class Folds {
 public:
  Folds(const Evidence& evidence, const Fit& fit)
      : fit_(fit),
        ridge_(wide_prior(evidence.floor)),
        all_(fit.readings),
        error_(fit.sums.size(), 0.0),
        times_(fit.sums.size(), 0) {
    for (const NormalEquations& sums : fit.sums) all_ += sums;
  }

  void leave_out(const Fold& fold) {
    const NormalEquations rest = without(fold);
    if (can_do_without(rest.JJ, all_.JJ)) return judge(fold, rest);
    for (const std::size_t block : fold) judge({block}, without({block}));
  }

  HeldOut errors() const {
    HeldOut held;
    double rows = 0;
    double squares = 0;
    for (std::size_t b = 0; b < error_.size(); ++b) {
      held.by_block.push_back(times_[b] > 0 ? error_[b] / times_[b] : std::numeric_limits<double>::quiet_NaN());
      if (times_[b] == 0) continue;
      rows += fit_.sums[b].rows;
      squares += fit_.sums[b].rows * held.by_block[b];
    }
    held.mean_square = rows > 0 ? squares / rows : fit_.mean_square;
    return held;
  }

 private:
  NormalEquations without(const Fold& fold) const {
    NormalEquations rest = all_;
    for (const std::size_t block : fold) rest -= fit_.sums[block];
    return rest;
  }

  void judge(const Fold& fold, const NormalEquations& rest) {
    const Eigen::VectorXd step = least_squares_step(rest, fit_.x, ridge_);
    for (const std::size_t block : fold) {
      const NormalEquations& sums = fit_.sums[block];
      error_[block] += std::max(0.0, sums.squares_after(step)) / sums.rows;
      ++times_[block];
    }
  }

  const Fit& fit_;
  double ridge_;
  NormalEquations all_;
  std::vector<double> error_;
  std::vector<int> times_;
};

}  // namespace

HeldOut hold_out(const Evidence& evidence, const Fit& fit, const std::vector<Fold>& folds) {
  Folds held(evidence, fit);
  for (const Fold& fold : folds) held.leave_out(fold);
  return held.errors();
}

}  // namespace fusee
