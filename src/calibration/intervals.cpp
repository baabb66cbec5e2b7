#include "calibration/intervals.h"

#include <cstdint>
#include <map>

namespace fusee {
namespace {

constexpr int k_resamples = 400;

/// Makes equations solvable that say nothing of a number, which then goes to zero, and is nothing beside those that say
/// anything: a step that moves a single row by 1e-8 rad has 1e-16. No prior: an interval that is asked whether it holds
/// zero must not be pulled there.
constexpr double k_solvable = 1e-18;

/// A small generator of our own: the same intervals on every machine.
class Dice {
 public:
  std::size_t below(std::size_t n) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<std::size_t>((state_ >> 33) % n);
  }

 private:
  std::uint64_t state_ = 20180417;
};

/// Each x as strokes drawn anew would have it, sorted.
std::vector<std::vector<double>> resampled(const Fit& fit) {
  const auto count = static_cast<std::size_t>(fit.x.size());
  std::vector<std::vector<double>> values(count);
  Dice dice;
  for (int resample = 0; resample < k_resamples; ++resample) {
    NormalEquations drawn = fit.readings;
    for (std::size_t i = 0; i < fit.sums.size(); ++i) drawn += fit.sums[dice.below(fit.sums.size())];
    const Eigen::VectorXd x = fit.x + least_squares_step(drawn, fit.x, k_solvable);
    for (std::size_t k = 0; k < count; ++k) values[k].push_back(x[static_cast<Eigen::Index>(k)]);
  }
  for (std::vector<double>& one : values) std::sort(one.begin(), one.end());
  return values;
}

/// (Σ J Jᵀ)⁻¹
Eigen::MatrixXd inverse_information(const Fit& fit) {
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(fit.x.size(), fit.x.size());
  Eigen::MatrixXd information = fit.readings.JJ + k_solvable * identity;
  for (const NormalEquations& sums : fit.sums) information += sums.JJ;
  return information.ldlt().solve(identity);
}

/// Spread of the fitted x that the scatter between runs makes (clusters); zero with fewer than three runs.
Eigen::VectorXd scatter_between_runs(const Evidence& evidence, const Fit& fit) {
  std::map<std::size_t, Eigen::VectorXd> pulls;
  for (std::size_t b = 0; b < fit.sums.size(); ++b) {
    auto [place, added] = pulls.try_emplace(evidence.blocks[b].run, Eigen::VectorXd::Zero(fit.x.size()));
    place->second += fit.sums[b].Jr;
  }
  const double runs = static_cast<double>(pulls.size());
  if (runs < 3 || fit.x.size() == 0) return Eigen::VectorXd::Zero(fit.x.size());
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(fit.x.size(), fit.x.size());
  for (const auto& [run, pull] : pulls) scatter += pull * pull.transpose();
  const Eigen::MatrixXd inverse = inverse_information(fit);
  return (runs / (runs - 1.0) * inverse * scatter * inverse).diagonal().cwiseMax(0.0).cwiseSqrt();
}

}  // namespace

std::vector<ConfidenceInterval> intervals(const Evidence& evidence, const Fit& fit) {
  const std::vector<std::vector<double>> values = resampled(fit);
  const Eigen::VectorXd between = scatter_between_runs(evidence, fit);
  std::vector<ConfidenceInterval> found(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double centre = fit.x[static_cast<Eigen::Index>(k)];
    const double half = 1.96 * between[static_cast<Eigen::Index>(k)];
    found[k].low = std::min(values[k][k_resamples / 40], centre - half);
    found[k].high = std::max(values[k][k_resamples - 1 - k_resamples / 40], centre + half);
    found[k].deviation = 0.25 * (found[k].high - found[k].low);
  }
  return found;
}

bool excludes_zero(const Evidence& evidence, const Fit& fit, const Effect& effect) {
  const std::vector<ConfidenceInterval> ranges = intervals(evidence, fit);
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    for (const EffectParameter& own : effect.parameters) {
      if (&own == fit.parameters[k] && (ranges[k].low > 0 || ranges[k].high < 0)) return true;
    }
  }
  return false;
}

}  // namespace fusee
