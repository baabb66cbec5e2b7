#include "calibration/selection.h"

#include <algorithm>
#include <cmath>

namespace fusee {
namespace {

/// An effect smaller than this part of the noise floor is not worth a name: the model's own error may be as large.
constexpr double k_least_drop = 0.5;
/// A cause explains a good part of what stands above the floor; what explains a small part of it is the neighbour of a cause unknown.
constexpr double k_least_share = 0.30;
constexpr double k_least_bic_drop = 6.0;
/// Two explanations are one if their errors differ by less than this part of the floor's square, however surely they do.
constexpr double k_same = 0.03;
constexpr std::size_t k_most_effects = 5;
constexpr std::size_t k_pair_leaders = 3;

class Selector {
 public:
  Selector(const Evidence& evidence, Forward& forward, const std::function<void(const std::string&, double)>& progress)
      : evidence_(evidence), forward_(forward), progress_(progress) {}

  Selection run();

 private:
  struct Trial {
    Fit fit;
    Candidate candidate;
  };

  Trial trial(const Fit& before, const EffectSet& added);
  bool accepted(const Fit& before, const Fit& after, Candidate& candidate) const;
  bool add_one();
  bool add_two(const std::vector<Trial>& singles);
  void take(const Fit& fit) { selection_.best = fit; }
  void drop_needless();
  void describe_found();
  void describe_detectable();
  Fit without(const Effect* effect, const Effect* instead);
  bool at_floor(const Fit& fit) const { return fit.held_out_mean_square <= noise_limit(evidence_.floor); }
  bool has(const Effect& effect) const {
    const EffectSet& all = selection_.best.effects;
    return std::find(all.begin(), all.end(), &effect) != all.end();
  }
  void report(const std::string& what, double share) const {
    if (progress_) progress_(what, share);
  }

  const Evidence& evidence_;
  Forward& forward_;
  const std::function<void(const std::string&, double)>& progress_;
  Selection selection_;
};

bool Selector::accepted(const Fit& before, const Fit& after, Candidate& candidate) const {
  if (!after.usable) {
    candidate.why = "the joint could not be simulated with it";
    return false;
  }
  const double floor2 = evidence_.floor * evidence_.floor;
  const Comparison drop = compare(evidence_, before, after);
  candidate.held_out_rms = std::sqrt(after.held_out_mean_square);
  candidate.margin = drop.t;
  candidate.delta_bic = bic_drop(evidence_, before, after);
  const double gain = before.held_out_mean_square - after.held_out_mean_square;
  const double excess = std::max(1e-30, before.held_out_mean_square - floor2);
  if (!(gain > std::pow(k_least_drop * evidence_.floor, 2))) {
    candidate.why = "the held-out error does not fall by what the noise would show";
  } else if (!(drop.t > drop.needed_t) || !(drop.t_over_runs > 1.0)) {
    candidate.why = "the held-out error falls in some strokes and not in others";
  } else if (!(candidate.delta_bic > k_least_bic_drop)) {
    candidate.why = "too many numbers for what it explains";
  } else if (!(gain > k_least_share * excess)) {
    candidate.why = "it explains a small part of what is there";
  } else {
    return true;
  }
  return false;
}

bool excludes_zero(const Evidence& evidence, const Fit& fit, const Effect& effect) {
  const std::vector<const EffectParameter*> parameters = varied(*evidence.declared, fit.effects);
  const std::vector<Interval> ranges = intervals(fit);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    for (const EffectParameter& own : effect.parameters) {
      if (&own == parameters[k] && (ranges[k].low > 0 || ranges[k].high < 0)) return true;
    }
  }
  return false;
}

Selector::Trial Selector::trial(const Fit& before, const EffectSet& added) {
  Trial result;
  EffectSet effects = before.effects;
  effects.insert(effects.end(), added.begin(), added.end());
  for (const Effect* effect : added) result.candidate.name += (result.candidate.name.empty() ? "" : " + ") + effect->name;
  result.fit = fit_effects(evidence_, forward_, effects, before.at);
  bool holds = accepted(before, result.fit, result.candidate);
  for (const Effect* effect : added) {
    if (!holds || excludes_zero(evidence_, result.fit, *effect)) continue;
    holds = false;
    result.candidate.why = "the interval of " + effect->name + " holds zero";
  }
  result.candidate.accepted = holds;
  return result;
}

bool Selector::add_one() {
  std::vector<Trial> singles;
  const std::size_t count = selection_.catalogue.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Effect& effect = selection_.catalogue[i];
    if (has(effect)) continue;
    report("trying " + effect.name, static_cast<double>(i) / static_cast<double>(count));
    singles.push_back(trial(selection_.best, {&effect}));
  }
  const auto better = [](const Trial& a, const Trial& b) { return a.fit.held_out_mean_square < b.fit.held_out_mean_square; };
  singles.erase(std::remove_if(singles.begin(), singles.end(), [](const Trial& t) { return !t.fit.usable; }), singles.end());
  std::stable_sort(singles.begin(), singles.end(), better);
  const auto first = std::find_if(singles.begin(), singles.end(), [](const Trial& t) { return t.candidate.accepted; });
  if (first == singles.end()) {
    const bool together = add_two(singles);
    for (const Trial& single : singles) selection_.tried.push_back(single.candidate);
    return together;
  }
  for (Trial& single : singles) {
    if (&single == &*first) continue;
    if (single.candidate.accepted) single.candidate.why = first->candidate.name + " explains more";
    single.candidate.accepted = false;
    selection_.tried.push_back(single.candidate);
  }
  first->candidate.why = "the held-out error falls by " + std::to_string(static_cast<int>(first->candidate.margin)) + " standard errors";
  selection_.tried.push_back(first->candidate);
  take(first->fit);
  return true;
}

// What comes in pairs: neither explains enough alone.
bool Selector::add_two(const std::vector<Trial>& singles) {
  if (selection_.best.effects.size() + 2 > k_most_effects) return false;
  Trial best;
  const std::size_t leaders = std::min(k_pair_leaders, singles.size());
  const std::size_t seconds = std::min<std::size_t>(6, singles.size());
  for (std::size_t i = 0; i < leaders; ++i) {
    for (std::size_t j = i + 1; j < seconds; ++j) {
      report("trying pairs", static_cast<double>(i * seconds + j) / static_cast<double>(leaders * seconds));
      Trial pair = trial(selection_.best, {singles[i].fit.effects.back(), singles[j].fit.effects.back()});
      // Each must be needed beside the other.
      Candidate scratch;
      if (!pair.candidate.accepted || !accepted(singles[i].fit, pair.fit, scratch) || !accepted(singles[j].fit, pair.fit, scratch)) continue;
      if (best.fit.usable && best.fit.held_out_mean_square <= pair.fit.held_out_mean_square) continue;
      best = std::move(pair);
    }
  }
  if (!best.fit.usable) return false;
  best.candidate.why = "neither explains enough alone";
  selection_.tried.push_back(best.candidate);
  take(best.fit);
  return true;
}

Fit Selector::without(const Effect* effect, const Effect* instead) {
  EffectSet effects;
  Imperfections from = selection_.best.at;
  for (const Effect* other : selection_.best.effects) {
    if (other != effect) effects.push_back(other);
  }
  for (const EffectParameter& parameter : effect->parameters) from.*parameter.member = 0;
  if (instead) effects.push_back(instead);
  return fit_effects(evidence_, forward_, effects, from);
}

void Selector::drop_needless() {
  for (std::size_t i = 0; i < selection_.best.effects.size() && selection_.best.effects.size() > 1;) {
    const Effect* effect = selection_.best.effects[i];
    const Fit fewer = without(effect, nullptr);
    Candidate candidate;
    if (!fewer.usable || accepted(fewer, selection_.best, candidate)) {
      ++i;
      continue;
    }
    candidate.name = effect->name;
    candidate.why = "needless beside the others";
    selection_.tried.push_back(candidate);
    take(fewer);
    i = 0;
  }
}

void Selector::describe_found() {
  const std::vector<const EffectParameter*> parameters = varied(*evidence_.declared, selection_.best.effects);
  const std::vector<Interval> ranges = intervals(selection_.best);
  const double floor2 = evidence_.floor * evidence_.floor;
  for (const Effect* effect : selection_.best.effects) {
    FoundEffect found;
    found.name = effect->name;
    found.place = effect->place;
    found.correctable_by = effect->correctable_by;
    found.group = {effect->name};
    for (const EffectParameter& own : effect->parameters) {
      double low = selection_.best.at.*own.member;
      double high = low;
      for (std::size_t k = 0; k < parameters.size(); ++k) {
        if (parameters[k] != &own) continue;
        low = std::clamp(ranges[k].low * own.step, own.least, own.most);
        high = std::clamp(ranges[k].high * own.step, own.least, own.most);
      }
      FittedParameter fitted{own.name, own.shown(selection_.best.at.*own.member, *evidence_.declared), own.shown(low, *evidence_.declared),
                             own.shown(high, *evidence_.declared)};
      if (fitted.low > fitted.high) std::swap(fitted.low, fitted.high);
      found.parameters.push_back(fitted);
    }
    const Fit fewer = without(effect, nullptr);
    found.rms_drop = std::sqrt(fewer.held_out_mean_square) - std::sqrt(selection_.best.held_out_mean_square);
    for (const Effect& rival : selection_.catalogue) {
      if (has(rival)) continue;
      const Fit instead = without(effect, &rival);
      if (!instead.usable) continue;
      const Comparison worse = compare(evidence_, instead, selection_.best);
      if (worse.mean <= std::max(worse.standard_error, k_same * floor2)) found.group.push_back(rival.name);
    }
    selection_.found.push_back(std::move(found));
  }
}

void Selector::describe_detectable() {
  for (const Effect& effect : selection_.catalogue) {
    if (has(effect)) continue;
    EffectSet effects = selection_.best.effects;
    effects.push_back(&effect);
    const Fit fit = fit_effects(evidence_, forward_, effects, selection_.best.at);
    if (!fit.usable) continue;
    const std::vector<const EffectParameter*> parameters = varied(*evidence_.declared, effects);
    const std::vector<Interval> ranges = intervals(fit);
    double least = 0;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      for (const EffectParameter& own : effect.parameters) {
        if (parameters[k] != &own) continue;
        const double sensitivity = fit.J.col(static_cast<Eigen::Index>(k)).norm() / std::sqrt(static_cast<double>(fit.J.rows()));
        least = std::max(least, 2.8 * ranges[k].deviation * sensitivity);
      }
    }
    selection_.detectable.push_back({effect.name, std::max(least, k_least_drop * evidence_.floor)});
  }
}

Selection Selector::run() {
  selection_.catalogue = catalogue(*evidence_.declared, evidence_.measurement);
  selection_.none = fit_effects(evidence_, forward_, {}, {});
  selection_.best = selection_.none;
  if (!selection_.none.usable) return std::move(selection_);
  while (!at_floor(selection_.best) && selection_.best.effects.size() < k_most_effects && add_one()) {
  }
  drop_needless();
  report("rivals", 0.5);
  describe_found();
  report("what would have been seen", 0.9);
  describe_detectable();
  return std::move(selection_);
}

}  // namespace

double noise_limit(double floor) { return (1.0 + k_least_drop * k_least_drop) * floor * floor; }

Selection select_effects(const Evidence& evidence, Forward& forward, const std::function<void(const std::string&, double)>& progress) {
  Selection selection = Selector(evidence, forward, progress).run();
  return selection;
}

}  // namespace fusee
