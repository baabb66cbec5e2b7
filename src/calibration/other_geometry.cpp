#include "calibration/other_geometry.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "calibration/parameters.h"
#include "calibration/row_facts.h"
#include "fusee/mechanism/effect.h"

// A curve beside the readings knows nothing of moment arms: under load a path that is longer by a curve turns the joint
// further where its arm is smaller, as every geometry does, and the names of geometry were then far ahead of all that
// has none (unheard split, seeds 241038 and 241092: a flexure's centre that wanders, as a runout, by 52 and 206 nats;
// by 4 and less of such paths). So the set without the effect is fitted again with them, a slope, a square and a cube
// of the angle each: a tendon that leaves its drum aslant has all three (251083, 251117: 173 and 27 nats without a
// slope).
//
// Both paths may be long by so much that a fit from none ends on a wrong summit (241041: 39 nats below; 241063: 30), so
// it begins with curves of both signs too. And what was found to mend the name's fit is not wanted beside the paths
// (241096: a drum's radius, 21 nats): the others go one by one as long as the evidence grows. What acts one way, or
// under a load alone, is no geometry, and is not asked: such fits were a quarter of a calibration's time.

namespace fusee {
namespace {

/// mm at 57 degrees, a quarter of it at 29: pins, levers and pulleys are off by as much.
constexpr double k_prior = 2.0;

EffectParameter path_parameter(const char* name, double& (*number)(Imperfections&)) {
  EffectParameter parameter;
  parameter.name = name;
  parameter.number = number;
  parameter.least = -20;
  parameter.most = 20;
  parameter.step = 1e-2;
  parameter.prior = k_prior;
  return parameter;
}

/// In no catalogue: nobody could look for it with a caliper.
const Effect& longer_paths() {
  static const Effect effect = [] {
    Effect paths;
    paths.name = "longer_paths";
    paths.parameters = {path_parameter("slope1", [](Imperfections& at) -> double& { return at.joint.path1.slope; }),
                        path_parameter("slope2", [](Imperfections& at) -> double& { return at.joint.path2.slope; }),
                        path_parameter("square1", [](Imperfections& at) -> double& { return at.joint.path1.square; }),
                        path_parameter("cube1", [](Imperfections& at) -> double& { return at.joint.path1.cube; }),
                        path_parameter("square2", [](Imperfections& at) -> double& { return at.joint.path2.square; }),
                        path_parameter("cube2", [](Imperfections& at) -> double& { return at.joint.path2.cube; })};
    return paths;
  }();
  return effect;
}

/// mm/rad², of both paths, where a fit begins.
constexpr std::array k_starts = {0.0, 3.0, -3.0};
/// Nats that may be gained by what is not wanted beside the paths: 3 to 9 on seven joints, once 21.
constexpr double k_most_by_idle_ones = 25.0;
constexpr int k_bins_of_a_span = 16;
/// Of what an effect does, squared, the part that is alike at a place from which on paths may be it: of geometry 0.35
/// (a lever) to 1, of play and of a stretch under loads of either sign 0.06 and less.
constexpr double k_least_of_place = 0.15;

/// None where its paths do as well without none of its effects.
std::optional<Fit> without_one_more(const Fitter& fitter, const Fit& fit) {
  for (const Effect* effect : fit.effects) {
    if (effect == &longer_paths()) continue;
    Fit fewer = fitter.fit(without(fit.effects, *effect), without(fit.at, *effect));
    if (fewer.usable && score(fewer) > score(fit)) return fewer;
  }
  return std::nullopt;
}

/// `fit` without the effects that its paths do as well without.
Fit without_idle_ones(const Fitter& fitter, Fit fit) {
  while (std::optional<Fit> fewer = without_one_more(fitter, fit)) fit = std::move(*fewer);
  return fit;
}

double score_of_usable(const Fit& fit) { return fit.usable ? score(fit) : -std::numeric_limits<double>::infinity(); }

/// Of `others` with longer paths, from one start.
Fit with_longer_paths(const Fitter& fitter, const Fit& others, double square) {
  EffectSet effects = others.effects;
  effects.push_back(&longer_paths());
  Imperfections start = others.at;
  start.joint.path1.square = start.joint.path2.square = square;
  return fitter.fit(effects, start);
}

using FromStarts = std::array<Fit, k_starts.size()>;

/// By the starts in their order until one is as good as `enough`.
double best_of(const Fitter& fitter, FromStarts& fits, double enough) {
  Fit* best = &fits.front();
  for (Fit& fit : fits) {
    if (score_of_usable(*best) > enough) break;
    if (score_of_usable(fit) > score_of_usable(*best)) best = &fit;
  }
  if (score_of_usable(*best) < enough - k_most_by_idle_ones) return score_of_usable(*best);
  return score(without_idle_ones(fitter, std::move(*best)));
}

/// Which part of what an effect does, squared, is the same at a place whichever way, load and run.
double share_of_place(const std::vector<RowFacts>& rows, const Eigen::VectorXd& done) {
  std::array<double, k_bins_of_a_span> sums{}, counts{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto place = static_cast<std::size_t>(place_bin(rows[i], k_bins_of_a_span));
    sums[place] += done[static_cast<Eigen::Index>(i)];
    counts[place] += 1;
  }
  double squares = 0;
  for (std::size_t place = 0; place < k_bins_of_a_span; ++place)
    squares += counts[place] > 0 ? sums[place] * sums[place] / counts[place] : 0.0;
  return squares / std::max(done.squaredNorm(), std::numeric_limits<double>::min());
}

}  // namespace

std::vector<double> under_other_geometry(const Evidence& evidence, Workers& workers, const Selection& selection,
                                         const std::vector<bool>& asked, double enough) {
  std::vector<double> scores(asked.size(), -std::numeric_limits<double>::infinity());
  if (evidence.declared->transmission) return scores;
  const std::vector<RowFacts> rows = row_facts(evidence);
  std::vector<double> shares(asked.size());
  workers.each(asked.size(), [&](const Fitter& fitter, std::size_t i) {
    if (asked[i] && selection.without[i].usable)
      shares[i] = share_of_place(rows, fitter.done_by(selection.best, *selection.best.effects[i]));
  });
  std::vector<FromStarts> fits(asked.size());
  workers.each(asked.size() * k_starts.size(), [&](const Fitter& fitter, std::size_t task) {
    const std::size_t i = task / k_starts.size(), start = task % k_starts.size();
    if (shares[i] >= k_least_of_place)
      fits[i][start] = with_longer_paths(fitter, selection.without[i], k_starts[start]);
  });
  workers.each(asked.size(),
               [&](const Fitter& fitter, std::size_t i) { scores[i] = best_of(fitter, fits[i], enough); });
  return scores;
}

}  // namespace fusee
