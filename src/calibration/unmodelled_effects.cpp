#include "calibration/unmodelled_effects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "base/decompositions.h"
#include "calibration/parameters.h"
#include "calibration/row_facts.h"
#include "calibration/thresholds.h"
#include "joint/forward.h"

// A curve beside the readings has no moment arms and tensions. Two kinds of unmodelled causes act through them:
//
// - Geometry. A deviation of a path's length turns the joint further where its moment arm is smaller, as every geometric
// effect does. Without such paths effects of geometry exceeded all unmodelled alternatives (held-out seeds 241038 and
// 241092: the wandering centre of a flexure, as a runout, by 52 and 206 nats; by 4 at most with them). So the set
// without the effect is refitted with a linear, a quadratic and a cubic term of the angle for each tendon. A tendon that
// leaves its drum at an angle has all three (251083, 251117: 173 and 27 nats without the linear one). From zero, large
// deviations of both paths may end at a wrong mode (241041: 39 nats below; 241063: 30). Curves of both signs are
// therefore further starts.
//
// - Friction by another law. It holds the joint within the tendons' compliance, as every friction does, but in
// proportion neither to their tension, as on pins, nor to a constant, as in a bearing (held-out seeds 271100, 271143,
// 271150: fibres by Howell's law, as friction of a bearing, by 19 to 224 nats; 241065, 241071: tendons that rub on each
// other).
//
// Effects that only completed the replaced effect are not required beside an unmodelled one (241096: a drum's radius,
// 21 nats). They are removed one by one as long as the score rises. To save fits, which took a quarter of a
// calibration's time, each kind is tested only if the effect contributes to it: to geometry by the part that is equal
// at a place, to friction by the part that is odd in direction.

// Wrong loads are no shape beside a fit: a tendon becomes slack under 20 N and not under 15 N, and its compliance is
// then fitted anew. So the set without the effect is refitted to the same readings with all loads scaled, over a ladder
// of factors first, then more closely about the best.

namespace fusee::calibration {
namespace {

/// Usual deviation of a path at 57 degrees, mm; a quarter of it at 29 degrees. Errors of pins, levers and pulleys cause
/// as much.
constexpr double k_usual_path = 2.0;
/// Usual friction, N·mm: that of a bearing; pins have more.
constexpr double k_usual_rubbing = 100.0;
/// Nats that removals may gain: 3 to 9 on seven joints, once 21.
constexpr double k_most_by_idle_effects = 25.0;
constexpr int k_bins_of_a_span = 16;
/// Least share of a contribution's squares that is of a kind. Geometry has 0.35 (a lever) to 1 equal at a place, play
/// and stretch under loads of both signs at most 0.06.
constexpr double k_least_of_its_kind = 0.15;

EffectParameter number_of(const char* name, double& (*number)(Imperfections&), double least, double most, double step,
                          double prior) {
  EffectParameter parameter;
  parameter.name = name;
  parameter.number = number;
  parameter.least = least;
  parameter.most = most;
  parameter.step = step;
  parameter.prior = prior;
  return parameter;
}

EffectParameter path_number(const char* name, double& (*number)(Imperfections&)) {
  return number_of(name, number, -20, 20, 1e-2, k_usual_path);
}

EffectParameter rubbing_number(const char* name, double& (*number)(Imperfections&)) {
  return number_of(name, number, 0, 1e5, 0.5, k_usual_rubbing);
}

fusee::Effect longer_paths() {
  fusee::Effect paths;
  paths.name = "longer_paths";
  paths.parameters = {path_number("slope1", [](Imperfections& at) -> double& { return at.joint.path1.slope; }),
                      path_number("slope2", [](Imperfections& at) -> double& { return at.joint.path2.slope; }),
                      path_number("square1", [](Imperfections& at) -> double& { return at.joint.path1.square; }),
                      path_number("cube1", [](Imperfections& at) -> double& { return at.joint.path1.cube; }),
                      path_number("square2", [](Imperfections& at) -> double& { return at.joint.path2.square; }),
                      path_number("cube2", [](Imperfections& at) -> double& { return at.joint.path2.cube; })};
  paths.starts = {{0, 0, 0, 0, 0, 0}, {0, 0, 3, 0, 3, 0}, {0, 0, -3, 0, -3, 0}};
  return paths;
}

fusee::Effect rubbing() {
  fusee::Effect friction;
  friction.name = "rubbing";
  friction.parameters = {
      rubbing_number("by_area_Nmm", [](Imperfections& at) -> double& { return at.joint.rubbing.by_area; }),
      rubbing_number("by_lesser_Nmm", [](Imperfections& at) -> double& { return at.joint.rubbing.by_lesser; })};
  friction.starts = {{100, 0}, {0, 100}, {1000, 0}, {0, 1000}};
  friction.sticks = true;
  return friction;
}

/// Sum over bins of the rows of the squares of the bins' means.
template <std::size_t parts, typename Part>
double alike(const std::vector<RowFacts>& rows, const Eigen::VectorXd& contribution, Part part) {
  std::array<double, parts> sums{}, counts{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto own = static_cast<std::size_t>(part(rows[i]));
    sums[own] += contribution[static_cast<Eigen::Index>(i)];
    counts[own] += 1;
  }
  double squares = 0;
  for (std::size_t own = 0; own < parts; ++own) squares += counts[own] > 0 ? sums[own] * sums[own] / counts[own] : 0.0;
  return squares;
}

/// Squares that are equal at a place, for any direction, load and run.
double alike_at_a_place(const std::vector<RowFacts>& rows, const Eigen::VectorXd& contribution) {
  return alike<k_bins_of_a_span>(rows, contribution,
                                 [](const RowFacts& row) { return place_bin(row, k_bins_of_a_span); });
}

/// Squares that are equal at a place in one direction, beyond those equal in both.
double alike_one_way(const std::vector<RowFacts>& rows, const Eigen::VectorXd& contribution) {
  const auto part = [](const RowFacts& row) { return 2 * place_bin(row, k_bins_of_a_span) + (row.direction > 0); };
  return alike<2 * k_bins_of_a_span>(rows, contribution, part) - alike_at_a_place(rows, contribution);
}

struct UnmodelledEffect {
  fusee::Effect effect;
  double (*of_its_kind)(const std::vector<RowFacts>& rows, const Eigen::VectorXd& contribution);
  const char* words;
  const char* separating_run;
};

/// Effects outside the catalogue: no caliper can verify them.
const std::array<UnmodelledEffect, 2>& unmodelled_effects() {
  static const std::array<UnmodelledEffect, 2> all = {{
      {longer_paths(), alike_at_a_place,
       "tendons' paths that are longer or shorter by a smooth curve of the joint's angle",
       "measure pins, lever and pulley with a caliper"},
      {rubbing(), alike_one_way,
       "a friction that is not proportional to the tendons' tension, or depends on the lesser of both tensions",
       "repeat one run with twice and with four times the pretension: the growth of the hysteresis shows its law"},
  }};
  return all;
}

/// The refit without the first other effect that lowers the score beside `unmodelled`; none without one.
std::optional<Fit> remove_idle_effect(const Fitter& fitter, const Fit& fit, const fusee::Effect& unmodelled) {
  for (const fusee::Effect* effect : fit.effects) {
    if (effect == &unmodelled) continue;
    Fit fewer = fitter.fit(without(fit.effects, *effect), without(fit.at, *effect));
    if (fewer.usable && score(fewer) > score(fit)) return fewer;
  }
  return std::nullopt;
}

/// `fit` without the effects that lower the score beside `unmodelled`.
Fit remove_idle_effects(const Fitter& fitter, Fit fit, const fusee::Effect& unmodelled) {
  while (std::optional<Fit> fewer = remove_idle_effect(fitter, fit, unmodelled)) fit = std::move(*fewer);
  return fit;
}

double score_of_usable(const Fit& fit) { return fit.usable ? score(fit) : -std::numeric_limits<double>::infinity(); }

/// Fit of `others` with the effect, from one of its starts.
Fit fit_with_unmodelled(const Fitter& fitter, const Fit& others, const fusee::Effect& unmodelled,
                        const std::vector<double>& start) {
  EffectSet effects = others.effects;
  effects.push_back(&unmodelled);
  Imperfections at = others.at;
  for (std::size_t k = 0; k < start.size(); ++k) set_value(at, unmodelled.parameters[k], start[k]);
  return fitter.fit(effects, at);
}

/// Unmodelled effect in the place of an effect: a fit from each of its starts.
struct Substitute {
  std::size_t effect = 0;
  const UnmodelledEffect* unmodelled = nullptr;
  std::vector<Fit> fits;
  double score = -std::numeric_limits<double>::infinity();
};

/// Substitutes for the effects whose contribution is of the kind of an unmodelled effect.
std::vector<Substitute> substitutes_of(const Evidence& evidence, FitterPool& pool, const Selection& selection,
                                       const std::vector<bool>& asked) {
  const std::vector<RowFacts> rows = row_facts(evidence);
  std::vector<std::vector<Substitute>> of_effects(asked.size());
  pool.each(asked.size(), [&](const Fitter& fitter, std::size_t i) {
    if (!asked[i] || !selection.without[i].usable) return;
    const Eigen::VectorXd contribution = fitter.contribution_of(selection.best, *selection.best.effects[i]);
    const double all = std::max(contribution.squaredNorm(), std::numeric_limits<double>::min());
    for (const UnmodelledEffect& unmodelled : unmodelled_effects()) {
      if (unmodelled.of_its_kind(rows, contribution) >= k_least_of_its_kind * all)
        of_effects[i].push_back({i, &unmodelled, std::vector<Fit>(unmodelled.effect.starts.size())});
    }
  });
  std::vector<Substitute> substitutes;
  for (std::vector<Substitute>& own : of_effects) std::move(own.begin(), own.end(), std::back_inserter(substitutes));
  return substitutes;
}

/// Fits from each start, in parallel.
void fit_from_starts(FitterPool& pool, const Selection& selection, std::vector<Substitute>& substitutes) {
  struct Task {
    Substitute* substitute = nullptr;
    std::size_t start = 0;
  };
  std::vector<Task> tasks;
  for (Substitute& substitute : substitutes) {
    for (std::size_t start = 0; start < substitute.fits.size(); ++start) tasks.push_back({&substitute, start});
  }
  pool.each(tasks.size(), [&](const Fitter& fitter, std::size_t i) {
    const auto& [substitute, start] = tasks[i];
    const fusee::Effect& unmodelled = substitute->unmodelled->effect;
    substitute->fits[start] =
        fit_with_unmodelled(fitter, selection.without[substitute->effect], unmodelled, unmodelled.starts[start]);
  });
}

/// Best score of the starts in their order, up to one that exceeds `enough`.
double best_score(const Fitter& fitter, Substitute& substitute, double enough) {
  Fit* best = &substitute.fits.front();
  for (Fit& fit : substitute.fits) {
    if (score_of_usable(*best) > enough) break;
    if (score_of_usable(fit) > score_of_usable(*best)) best = &fit;
  }
  if (score_of_usable(*best) < enough - k_most_by_idle_effects) return score_of_usable(*best);
  return score(remove_idle_effects(fitter, std::move(*best), substitute.unmodelled->effect));
}

}  // namespace

std::vector<UnmodelledSubstitute> fit_unmodelled_effects(const Evidence& evidence, FitterPool& pool,
                                                         const Selection& selection, const std::vector<bool>& asked,
                                                         double enough) {
  std::vector<UnmodelledSubstitute> found(asked.size());
  if (evidence.declared->transmission) return found;
  std::vector<Substitute> substitutes = substitutes_of(evidence, pool, selection, asked);
  fit_from_starts(pool, selection, substitutes);
  pool.each(substitutes.size(), [&](const Fitter& fitter, std::size_t i) {
    substitutes[i].score = best_score(fitter, substitutes[i], enough);
  });
  for (const Substitute& substitute : substitutes) {
    if (substitute.score > found[substitute.effect].score)
      found[substitute.effect] = {substitute.score, substitute.unmodelled->words,
                                  substitute.unmodelled->separating_run};
  }
  return found;
}

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
