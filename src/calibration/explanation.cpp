#include "calibration/explanation.h"

#include <algorithm>
#include <cmath>

#include "fusee/base/text.h"

namespace fusee {
namespace {

/// The size that five of six would be found of: a one-sided 95 % test with 80 % power takes 2.5 standard errors, blocks
/// being few 2.8.
constexpr double k_detectable = 2.8;
/// Nothing smaller than this part of the noise is accepted (selection.cpp).
constexpr double k_least = 0.5;

std::vector<FittedParameter> fitted_parameters(const Evidence& evidence, const Fit& fit,
                                               const std::vector<Interval>& ranges, const Effect& effect) {
  const std::vector<const EffectParameter*> parameters = varied(*evidence.declared, fit.effects);
  std::vector<FittedParameter> fitted;
  for (const EffectParameter& own : effect.parameters) {
    const double value = fit.at.*own.member;
    double low = value;
    double high = value;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (parameters[k] != &own) continue;
      low = std::clamp(ranges[k].low * own.step, own.least, own.most);
      high = std::clamp(ranges[k].high * own.step, own.least, own.most);
    }
    const auto shown = [&](double x) { return own.shown(x, *evidence.declared); };
    fitted.push_back({own.name, shown(value), std::min(shown(low), shown(high)), std::max(shown(low), shown(high))});
  }
  return fitted;
}

std::string with_numbers(const Evidence& evidence, const Fit& fit, const Effect& effect) {
  std::string numbers;
  for (const EffectParameter& own : effect.parameters) {
    numbers += (numbers.empty() ? "" : ", ") + own.name + " = " +
               rounded(own.shown(fit.at.*own.member, *evidence.declared), 4);
  }
  return effect.name + " (" + numbers + ")";
}

}  // namespace

std::vector<FoundEffect> found_effects(const Evidence& evidence, Workers& workers, const Selection& selection) {
  const Fit& best = selection.best;
  const std::vector<Interval> ranges = intervals(evidence, best);
  std::vector<FoundEffect> all;
  for (const Effect* effect : best.effects) {
    FoundEffect found;
    found.name = effect->name;
    found.place = effect->place;
    found.correctable_by = effect->correctable_by;
    found.parameters = fitted_parameters(evidence, best, ranges, *effect);
    found.group = {effect->name};
    for (const Rival& rival : selection.rivals) {
      if (rival.accepted == effect && as_good(evidence, rival.fit, best)) found.group.push_back(rival.rival->name);
    }
    EffectSet others;
    Imperfections from = best.at;
    for (const EffectParameter& parameter : effect->parameters)
      from.*parameter.member = Imperfections{}.*parameter.member;
    std::copy_if(best.effects.begin(), best.effects.end(), std::back_inserter(others),
                 [&](const Effect* other) { return other != effect; });
    const Fit without = fit_effects(evidence, workers.one(), others, from);
    found.rms_drop = std::sqrt(without.by_factor.mean_square) - std::sqrt(best.by_factor.mean_square);
    all.push_back(std::move(found));
  }
  return all;
}

double rms_apart(const Evidence& evidence, const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  double squares = 0;
  double rows = 0;
  for (const Block& block : evidence.blocks) {
    for (const std::size_t i : block.rows) {
      const auto row = static_cast<Eigen::Index>(i);
      squares += (one[row] - other[row]) * (one[row] - other[row]);
      rows += 1;
    }
  }
  return rows > 0 ? std::sqrt(squares / rows) : 0.0;
}

std::vector<std::string> null_combinations(const Evidence& evidence, const Selection& selection) {
  std::vector<std::string> all;
  for (const Rival& rival : selection.rivals) {
    if (!as_good(evidence, rival.fit, selection.best)) continue;
    const double apart = rms_apart(evidence, rival.fit.residual, selection.best.residual);
    all.push_back(with_numbers(evidence, selection.best, *rival.accepted) + " or " +
                  with_numbers(evidence, rival.fit, *rival.rival) + ": " + rounded(degrees(apart), 2) +
                  "° rms apart in these runs");
  }
  return all;
}

std::vector<Detectable> detectable_sizes(const Evidence& evidence, Workers& workers, const Selection& selection) {
  std::vector<const Effect*> others;
  for (const Effect& effect : selection.catalogue) {
    if (std::find(selection.best.effects.begin(), selection.best.effects.end(), &effect) ==
        selection.best.effects.end())
      others.push_back(&effect);
  }
  std::vector<double> sizes(others.size(), -1);
  workers.each(others.size(), [&](Forward& forward, std::size_t i) {
    const Fit wider = with_direction(evidence, forward, selection.best, *others[i]);
    if (!wider.usable) return;
    const std::vector<Interval> ranges = intervals(evidence, wider);
    sizes[i] = k_least * evidence.floor;
    for (Eigen::Index k = selection.best.x.size(); k < wider.x.size(); ++k) {
      const double sensitivity = wider.J.col(k).norm() / std::sqrt(static_cast<double>(wider.J.rows()));
      sizes[i] = std::max(sizes[i], k_detectable * ranges[static_cast<std::size_t>(k)].deviation * sensitivity);
    }
  });
  std::vector<Detectable> found;
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (sizes[i] >= 0 && std::isfinite(sizes[i])) found.push_back({others[i]->name, sizes[i]});
  }
  return found;
}

}  // namespace fusee
