#include "calibration/explanation.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/text.h"
#include "calibration/intervals.h"
#include "calibration/thresholds.h"

namespace fusee::calibration {
namespace {

/// Standard errors beyond the required size at which an effect is found in four cases of five.
constexpr double k_power = 0.84;

/// Intervals of each number of a fit: with other effects marginalised, and if there are none.
struct Ranges {
  std::vector<ConfidenceInterval> overall, if_only;
};

/// `range` in the number's own unit, clamped to its bounds.
std::pair<double, double> range_of(const EffectParameter& own, const ConfidenceInterval& range) {
  return {std::clamp(range.low * own.step, own.least, own.most),
          std::clamp(range.high * own.step, own.least, own.most)};
}

/// The interval of a settled number: its value, and the deviations of all numbers of the effect, as independent ones,
/// by their slopes. `fitted`: intervals of the parameters of `fit`.
ConfidenceInterval settled_interval(const fusee::Effect& effect, const EffectParameter& own, const Fit& fit,
                                    const std::vector<ConfidenceInterval>& fitted, const Mechanism& declared) {
  constexpr double k_small_step = 1e-3;  // of a parameter's step
  const auto settled_value = [&](Imperfections at) {
    effect.settle(at, declared);
    return value_of(at, own) / own.step;
  };
  const double x = settled_value(fit.at);
  double variance = 0;
  for (const Eigen::Index k : places_of(fit, effect)) {
    const EffectParameter& moved = *fit.parameters[static_cast<std::size_t>(k)];
    Imperfections beside = fit.at;
    set_value(beside, moved, value_of(fit.at, moved) + k_small_step * moved.step);
    const double change = (settled_value(beside) - x) / k_small_step * fitted[static_cast<std::size_t>(k)].deviation;
    variance += change * change;
  }
  return ConfidenceInterval::about(x, variance);
}

/// Rms effect of parameter `k` of a fit over the rows in use, rad.
double effect_on_joint(const Evidence& evidence, const Fit& fit, Eigen::Index k) {
  if (k >= fit.J.cols() || k >= fit.x.size()) return 0;
  const Eigen::VectorXd slope = fit.J(evidence.rows(), k);
  return std::abs(fit.x[k]) * slope.norm() / std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, slope.size())));
}

/// `ranges`: intervals of the parameters of `fit`.
std::vector<FittedParameter> fitted_parameters(const Evidence& evidence, const Fit& fit, const Ranges& ranges,
                                               const fusee::Effect& effect) {
  const Imperfections at = settled(evidence, effect, fit.at);
  const bool is_settled = !(at == fit.at);
  std::vector<FittedParameter> fitted;
  for (const EffectParameter& own : effect.parameters) {
    FittedParameter& number = fitted.emplace_back();
    number.name = own.name;
    if (is_idle(own, fit.at)) continue;
    const double value = value_of(at, own);
    std::pair<double, double> overall{value, value}, if_only{value, value};
    for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
      if (fit.parameters[k] != &own) continue;
      const auto interval = [&](const std::vector<ConfidenceInterval>& all) {
        return is_settled ? settled_interval(effect, own, fit, all, *evidence.declared) : all[k];
      };
      overall = range_of(own, interval(ranges.overall));
      if_only = range_of(own, interval(ranges.if_only));
      number.rms = effect_on_joint(evidence, fit, static_cast<Eigen::Index>(k));
      number.excludes_zero = if_only.first < if_only.second && (if_only.first > 0 || if_only.second < 0);
    }
    // Least-squares numbers may be outside the intervals about the mode.
    for (std::pair<double, double>* range : {&overall, &if_only})
      *range = {std::min(range->first, value), std::max(range->second, value)};
    const double before = evidence.earlier ? value_of(evidence.earlier->joint, own) : 0.0;
    const auto shown = [&](double x) { return own.shown(before + x, *evidence.declared); };
    number.value = shown(value);
    std::tie(number.low, number.high) = std::minmax({shown(overall.first), shown(overall.second)});
    std::tie(number.low_if_only, number.high_if_only) = std::minmax({shown(if_only.first), shown(if_only.second)});
    const bool has_sign = if_only.first > 0 || if_only.second < 0;
    if (has_sign) number.sense = value < 0 ? own.sign.below : own.sign.above;
  }
  return fitted;
}

std::string with_numbers(const Evidence& evidence, const Fit& fit, const fusee::Effect& effect) {
  std::string numbers;
  for (const EffectParameter& own : effect.parameters) {
    numbers +=
        (numbers.empty() ? "" : ", ") + own.name + " = " + rounded(shown_value(own, fit.at, *evidence.declared), 4);
  }
  return effect.name + " (" + numbers + ")";
}

/// Reduction of the held-out error by the effect at `place` beside the others, rad; from the declared joint if the
/// others alone cannot be simulated. At least 0.
double rms_drop(const Selection& selection, std::size_t place) {
  const Fit& others = selection.without[place];
  const Fit& before = others.usable ? others : selection.none;
  return std::max(0.0, std::sqrt(before.by_factor.mean_square) - std::sqrt(selection.best.by_factor.mean_square));
}

/// Reduction of the held-out mean square by the effect at `place`, as a share of that of the declared joint.
double share(const Selection& selection, std::size_t place) {
  const double all = selection.none.by_factor.mean_square, best = selection.best.by_factor.mean_square;
  const Fit& others = selection.without[place];
  const double without_it = others.usable ? others.by_factor.mean_square : all;
  return all > 0 ? std::clamp((without_it - best) / all, 0.0, 1.0) : 0.0;
}

/// True if the fitted `effect` moves the rows by no more than a fit of its numbers to noise alone would.
bool moves_nothing(const Evidence& evidence, const Fit& fit, const fusee::Effect& effect) {
  const double seen = contribution(evidence, fit, effect).squaredNorm() * evidence.evidence_model->independent_share();
  return seen < static_cast<double>(places_of(fit, effect).size()) * evidence.floor * evidence.floor;
}

/// Removes rivals that do nothing in the place of `effect` from the group of `found`.
void drop_idle_members(const Evidence& evidence, const Selection& selection, const fusee::Effect& effect,
                       FoundEffect& found) {
  for (const Rival& rival : selection.rivals) {
    if (rival.accepted != &effect || !moves_nothing(evidence, rival.fit, *rival.rival)) continue;
    found.idle_did_as_well |= std::erase(found.group, rival.rival->name) > 0;
  }
}

/// Adds effects that are reported beside the found set to the first group that contains them or has them as companions.
void place_beside(const Evidence& evidence, const Selection& selection, const Fit& numbers,
                  std::vector<FoundEffect>& found) {
  const std::vector<ConfidenceInterval> both = intervals(numbers);
  const Ranges ranges{both, both};
  for (const fusee::Effect* effect : numbers.effects) {
    if (contains(selection.best.effects, *effect)) continue;
    const auto group = std::find_if(selection.groups.begin(), selection.groups.end(), [&](const CredibleGroup& own) {
      return contains(own.members, *effect) || contains(own.companions, *effect);
    });
    FoundEffect& one = found[static_cast<std::size_t>(group - selection.groups.begin())];
    one.beside.push_back({effect->name, fitted_parameters(evidence, numbers, ranges, *effect)});
    if (!contains(group->members, *effect)) one.group.push_back(effect->name);
  }
}

}  // namespace

std::vector<const Rival*> equally_likely_rivals(const Selection& selection) {
  const Fit& best = selection.best;
  std::vector<const Rival*> all;
  for (const Rival& rival : selection.rivals) {
    const auto accepted = std::find(best.effects.begin(), best.effects.end(), rival.accepted);
    if (accepted == best.effects.end()) continue;  // rival of a set that was replaced
    const Fit& others = selection.without[static_cast<std::size_t>(accepted - best.effects.begin())];
    const bool does_nothing = others.usable && score(rival.fit) < score(others);
    if (!does_nothing && is_as_good(rival.fit, best)) all.push_back(&rival);
  }
  return all;
}

std::vector<FoundEffect> found_effects(const Evidence& evidence, const Selection& selection, const Fit& numbers) {
  const Fit& best = selection.best;
  const Ranges ranges{intervals(selection), intervals_if_only(selection)};
  const std::vector<const Rival*> rivals = equally_likely_rivals(selection);
  std::vector<FoundEffect> all;
  for (const fusee::Effect* effect : best.effects) {
    FoundEffect found;
    found.name = effect->name;
    found.place = effect->place;
    found.correctable_by = effect->correctable_by;
    found.parameters = fitted_parameters(evidence, numbers, ranges, *effect);
    for (const fusee::Effect* member : selection.groups[all.size()].members) found.group.push_back(member->name);
    for (const Rival* rival : rivals) {
      const bool in_group = std::count(found.group.begin(), found.group.end(), rival->rival->name) > 0;
      if (rival->accepted == effect && !in_group) found.group.push_back(rival->rival->name);
    }
    drop_idle_members(evidence, selection, *effect, found);
    for (const Rival& rival : selection.rivals) {
      const bool in_group = std::count(found.group.begin(), found.group.end(), rival.rival->name) > 0;
      if (rival.accepted != effect || !in_group) continue;
      const std::vector<ConfidenceInterval> own = intervals(rival.fit);
      found.alternatives.push_back(
          {rival.rival->name, fitted_parameters(evidence, rival.fit, {own, own}, *rival.rival)});
    }
    found.rms_drop = rms_drop(selection, all.size());
    found.share = share(selection, all.size());
    for (const Candidate& candidate : selection.tried)
      if (candidate.accepted && candidate.name == effect->name) found.evidence = candidate.evidence;
    all.push_back(std::move(found));
  }
  place_beside(evidence, selection, numbers, all);
  return all;
}

std::vector<std::string> null_combinations(const Evidence& evidence, const Selection& selection) {
  std::vector<std::string> all;
  for (const Rival* rival : equally_likely_rivals(selection)) {
    const double difference = rms_apart(evidence, rival->fit.residual, selection.best.residual);
    all.push_back(with_numbers(evidence, selection.best, *rival->accepted) + " or " +
                  with_numbers(evidence, rival->fit, *rival->rival) + ": " + rounded(degrees(difference), 2) +
                  "° rms apart in these runs");
  }
  return all;
}

std::vector<Detectable> detectable_sizes(const Evidence& evidence, FitterPool& pool, const Selection& selection) {
  const Fit& best = selection.best;
  EffectSet others = selection.catalogue;
  std::erase_if(others, [&](const fusee::Effect* effect) { return contains(best.effects, *effect); });
  std::vector<double> sizes(others.size(), -1);
  pool.each(others.size(), [&](const Fitter& fitter, std::size_t i) {
    const Fit wider = fitter.add_slopes(best, *others[i]);
    if (!wider.usable) return;
    const std::vector<ConfidenceInterval> ranges = intervals(wider);
    sizes[i] = 0;
    for (Eigen::Index k = best.x.size(); k < wider.x.size(); ++k) {
      const double sensitivity = wider.J.col(k).norm() / std::sqrt(static_cast<double>(wider.J.rows()));
      const double deviation = ranges[static_cast<std::size_t>(k)].deviation;
      const double width = elementary::log(std::max(1.0, tangent_of(evidence, wider).prior[k] / deviation));
      const double named = std::sqrt(2.0 * (reporting_penalty(*others[i]) + width)) + k_power;
      sizes[i] = std::max(sizes[i], named * deviation * sensitivity);
    }
  });
  std::vector<Detectable> found;
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (sizes[i] >= 0 && std::isfinite(sizes[i])) found.push_back({others[i]->name, sizes[i]});
  }
  return found;
}

}  // namespace fusee::calibration
