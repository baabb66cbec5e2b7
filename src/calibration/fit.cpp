#include "calibration/fit.h"

#include "calibration/misfit.h"
#include "calibration/starts.h"
#include "calibration/thresholds.h"
#include "measurement/strokes.h"

namespace fusee {

bool is_at_floor(const Fit& fit, double floor) { return held_out_square(fit) <= k_thresholds.at_floor * floor * floor; }

void hold_at_bounds(Fit& fit) {
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    if (at_bound(fit.at, *fit.parameters[k])) fit.J.col(static_cast<Eigen::Index>(k)).setZero();
  }
}

/// Of the residuals where a fit begins, rad.
struct Fitter::Spread {
  double middle = 0;
  double scale = 0;  ///< beyond a few of these a row is an outlier
};

Fitter::Spread Fitter::spread_about(const Imperfections& from) const {
  const Eigen::VectorXd before = model_.said(from).residual;
  std::vector<double> near;
  for (const Eigen::Index row : evidence().rows()) near.push_back(before[row]);
  const double middle = median_of(near);
  for (double& value : near) value = std::abs(value - middle);
  return {middle, std::max(evidence().floor, 1.5 * median_of(near))};
}

Fit Fitter::fit(const EffectSet& effects, const Imperfections& from) const {
  Fit fit;
  fit.effects = effects;
  fit.parameters = model_.varied(effects);
  const Spread spread = spread_about(from);
  Imperfections start = from;
  if (const EffectParameter* offset = free_offset(*evidence().declared); offset && value_of(from, *offset) == 0)
    set_value(start, *offset, spread.middle);
  const Minimum minimum = least_misfit(model_, fit.parameters, start, spread.scale);
  fit.usable = minimum.found;
  if (!fit.usable) return fit;
  fit.at = minimum.at;
  fit.x = minimum.x;
  linearise(fit);
  judge(fit);
  return fit;
}

void Fitter::linearise(Fit& fit) const {
  Said words = model_.said(fit.at);
  fit.residual = std::move(words.residual);
  fit.loose = std::move(words.loose);
  fit.J.resize(fit.residual.size(), fit.x.size());
  for (Eigen::Index k = 0; k < fit.x.size(); ++k) {
    const EffectParameter& parameter = *fit.parameters[static_cast<std::size_t>(k)];
    fit.J.col(k) = model_.slope(fit.at, parameter, fit.residual);
  }
  hold_at_bounds(fit);
}

void Fitter::judge(Fit& fit) const {
  fit.usable = fit.usable && is_finite(evidence(), fit);
  if (!fit.usable) return;
  fit.readings = sums_of_readings(evidence(), fit);
  fit.against_readings = against_readings(evidence(), fit.at);
  fit.sums.clear();
  double rows = 0;
  double squares = 0;
  double prices = 0;
  for (const Block& block : evidence().blocks) {
    fit.sums.push_back(sums_of(block, fit, evidence().floor));
    rows += fit.sums.back().rows;
    squares += fit.sums.back().rr;
    for (const std::size_t row : block.rows)
      prices += price_of_play(fit.loose[static_cast<Eigen::Index>(row)], evidence().floor);
  }
  fit.mean_square = squares / rows;
  fit.price = prices / rows;
  fit.by_factor = hold_out(evidence(), fit, evidence().factor_folds);
  fit.by_run = hold_out(evidence(), fit, evidence().run_folds);
}

Fit Fitter::with_direction(const Fit& fit, const Effect& effect) const {
  Fit wider = fit;
  wider.effects.push_back(&effect);
  wider.parameters = model_.varied(wider.effects);
  const std::vector<std::vector<double>> starts = starts_of(evidence(), fit, effect);
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const EffectParameter& parameter = effect.parameters[k];
    if (parameter.searched && !starts.empty()) set_value(wider.at, parameter, starts.front()[k]);
  }
  wider.x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(wider.parameters.size()));
  wider.x.head(fit.x.size()) = fit.x;
  wider.J.conservativeResize(Eigen::NoChange, wider.x.size());
  for (Eigen::Index k = fit.x.size(); k < wider.x.size(); ++k)
    wider.J.col(k) = model_.slope(wider.at, *wider.parameters[static_cast<std::size_t>(k)], fit.residual);
  judge(wider);
  return wider;
}

}  // namespace fusee
