// One effect more, by chords instead of tangents: the slopes of the parameters that the base has are its own, those of
// the effect are found anew at every step. So a candidate costs a dozen simulations, whatever stands beside it.

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/starts.h"

namespace fusee {
namespace {

/// Steps of a candidate's fit, and the share of the squares below which one more is not worth it.
constexpr int k_chords = 4;
constexpr double k_settled = 1e-3;
/// Of a step that made things worse.
constexpr double k_shorter = 0.3;

/// A step of the fit, kept within bounds.
Imperfections stepped(const Fit& fit, const Eigen::VectorXd& step) {
  Imperfections at = fit.at;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const EffectParameter& parameter = *fit.parameters[k];
    const auto i = static_cast<Eigen::Index>(k);
    set_value(at, parameter, std::clamp((fit.x[i] + step[i]) * parameter.step, parameter.least, parameter.most));
  }
  return at;
}

}  // namespace

/// A place, what it leaves, and the step from there to what a linear model promises.
struct Fitter::Chord {
  Fit fit;
  double squares = std::numeric_limits<double>::infinity();
  Eigen::VectorXd step;
  double promised = std::numeric_limits<double>::infinity();

  Chord() = default;
  Chord(const Evidence& evidence, Fit at) : fit(std::move(at)) {
    if (!is_finite(evidence, fit)) return;
    const NormalEquations normal = sums_of_all(evidence, fit);
    squares = normal.rr;
    step = least_squares_step(normal, fit.x, wide_prior(evidence.floor));
    promised = normal.squares_after(step);
  }
};

/// `base` with other effects beside it, everything at `at`: slopes of the effects' own parameters anew, those of the
/// others as they were.
Fit Fitter::widened(const Fit& base, const EffectSet& effects, const Imperfections& at) const {
  Fit wider;
  wider.effects = effects;
  wider.parameters = model_.varied(effects);
  wider.at = at;
  Said words = model_.said(at);
  wider.residual = std::move(words.residual);
  wider.loose = std::move(words.loose);
  wider.x.resize(static_cast<Eigen::Index>(wider.parameters.size()));
  wider.J.resize(wider.residual.size(), wider.x.size());
  wider.J.leftCols(base.x.size()) = base.J;
  for (Eigen::Index k = 0; k < wider.x.size(); ++k) {
    const EffectParameter& parameter = *wider.parameters[static_cast<std::size_t>(k)];
    wider.x[k] = value_of(at, parameter) / parameter.step;
    if (k >= base.x.size()) wider.J.col(k) = model_.slope(at, parameter, wider.residual);
  }
  wider.readings = sums_of_readings(evidence(), wider);
  return wider;
}

Fitter::Chord Fitter::best_start(const Fit& base, const Effect& effect) const {
  EffectSet effects = base.effects;
  effects.push_back(&effect);
  Chord best;
  for (const std::vector<double>& values : starts_of(evidence(), base, effect)) {
    Imperfections start = base.at;
    for (std::size_t k = 0; k < values.size(); ++k) set_value(start, effect.parameters[k], values[k]);
    Chord chord(evidence(), widened(base, effects, start));
    if (chord.promised < best.promised) best = std::move(chord);
  }
  return best;
}

Fit Fitter::with_effect(const Fit& base, const Effect& effect) const {
  Chord best = best_start(base, effect);
  if (!std::isfinite(best.promised)) return std::move(best.fit);
  for (int i = 0; i < k_chords; ++i) {
    Chord next(evidence(), widened(base, best.fit.effects, stepped(best.fit, best.step)));
    if (!(next.squares < best.squares)) {
      best.step *= k_shorter;
      continue;
    }
    const bool settled = next.squares > (1.0 - k_settled) * best.squares;
    best = std::move(next);
    if (settled) break;
  }
  best.fit.usable = true;
  hold_at_bounds(best.fit);
  judge(best.fit);
  return std::move(best.fit);
}

}  // namespace fusee
