#include "calibration/load_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/decompositions.h"
#include "calibration/thresholds.h"
#include "joint/forward.h"

// Wrong loads are no shape beside a fit: a tendon becomes slack under 20 N and not under 15 N, and its compliance is
// then fitted anew. So the set without the effect is refitted to the same readings with all loads scaled, over a ladder
// of factors first, then more closely about the best.

namespace fusee::calibration {
namespace {

constexpr std::array k_ladder = {0.5, 0.71, 0.84, 1.19, 1.41, 2.0};
/// Halvings of the ladder's step about its best.
constexpr int k_halvings = 3;
/// Share of a load scale's squares that one effect explains: above it that effect is equivalent to a load scale and no
/// rival.
constexpr double k_same = 0.8;
constexpr double k_slope_share = 0.05;

Evidence with_loads(const Evidence& evidence, double times) {
  Evidence other = evidence;
  for (joint::BenchRun& run : other.log) {
    for (joint::BenchRow& row : run.rows) row.load *= times;
  }
  return other;
}

bool has_loads(const Evidence& evidence) {
  return std::any_of(evidence.log.begin(), evidence.log.end(), [](const joint::BenchRun& run) {
    return run.has_load &&
           std::any_of(run.rows.begin(), run.rows.end(), [](const joint::BenchRow& row) { return row.load != 0; });
  });
}

/// Slope of the rows in use over the scale of all loads.
Eigen::VectorXd load_slope(const Evidence& evidence, const Fit& best) {
  const Evidence other = with_loads(evidence, 1.0 + k_slope_share);
  joint::Forward logged(*evidence.declared, evidence.log);
  joint::Forward wrong(*other.declared, other.log);
  const Eigen::VectorXd moved = (flat(wrong(best.at)) - flat(logged(best.at)))(evidence.rows());
  return moved.allFinite() ? moved : Eigen::VectorXd::Zero(moved.size());
}

/// Share of the squares of a load scale's slope that an effect of `best` explains.
double share_of(const Evidence& evidence, const Fit& best, const fusee::Effect& effect, const Eigen::VectorXd& slope) {
  const Tangent tangent = tangent_of(evidence, best);
  const std::vector<Eigen::Index> own = places_of(best, effect);
  if (own.empty() || !(slope.squaredNorm() > 0)) return 0;
  const Eigen::MatrixXd J = tangent.J(Eigen::all, own);
  const Eigen::VectorXd left = slope - J * solved(J.transpose() * J, Eigen::VectorXd(J.transpose() * slope));
  return 1.0 - left.squaredNorm() / slope.squaredNorm();
}

double score_under(const Evidence& evidence, const Fit& without, double times) {
  const Evidence other = with_loads(evidence, times);
  joint::Forward forward(*other.declared, other.log);
  const Fit fit = Fitter(other, forward).fit(without.effects, without.at);
  return fit.usable ? score(fit) - k_thresholds.neg_log_prior_odds - k_thresholds.strong
                    : -std::numeric_limits<double>::infinity();
}

/// Score −infinity if the logged loads are best.
LoadScaleFit best_under(const Evidence& evidence, const Fit& without) {
  LoadScaleFit best{1.0, score_under(evidence, without, 1.0)};
  const auto try_scale = [&](double times) {
    const double score = score_under(evidence, without, times);
    if (score > best.score) best = {times, score};
  };
  for (const double times : k_ladder) try_scale(times);
  double step = std::sqrt(k_ladder.back() / k_ladder[k_ladder.size() - 2]);
  for (int i = 0; i < k_halvings; ++i, step = std::sqrt(step)) {
    const double middle = best.times;
    try_scale(middle * step);
    try_scale(middle / step);
  }
  if (best.times == 1.0) best.score = -std::numeric_limits<double>::infinity();
  return best;
}

}  // namespace

std::vector<LoadScaleFit> fit_load_scales(const Evidence& evidence, FitterPool& pool, const Selection& selection) {
  const Fit& best = selection.best;
  std::vector<LoadScaleFit> all(best.effects.size(), {1.0, -std::numeric_limits<double>::infinity()});
  if (!has_loads(evidence)) return all;
  const Eigen::VectorXd slope = load_slope(evidence, best);
  std::vector<double> shares;
  for (const fusee::Effect* effect : best.effects) shares.push_back(share_of(evidence, best, *effect, slope));
  const double most = shares.empty() ? 0.0 : *std::max_element(shares.begin(), shares.end());
  pool.each(all.size(), [&](const Fitter&, std::size_t i) {
    const Fit& without = selection.without[i];
    const bool is_the_same = shares[i] > k_same && shares[i] == most;
    if (without.usable && !is_the_same) all[i] = best_under(evidence, without);
  });
  return all;
}

}  // namespace fusee::calibration
