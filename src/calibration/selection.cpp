#include "calibration/selection.h"

#include <algorithm>
#include <cmath>

// Greedy, with a look one step further: causes come in pairs, of which neither may explain much alone, and a third that resembles both may explain
// more than either. So pairs are tried from the best few wherever the best single does not reach the noise; and once there is a set, every
// member is held against every effect in its place, and gives way where that does better. What is needless beside the others goes last.

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
constexpr std::size_t k_pair_leaders = 4;
constexpr std::size_t k_pair_seconds = 8;
constexpr int k_most_exchanges = 4;

bool excludes_zero(const Evidence& evidence, const Fit& fit, const Effect& effect) {
  const std::vector<const EffectParameter*> parameters = varied(*evidence.declared, fit.effects);
  const std::vector<Interval> ranges = intervals(evidence, fit);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    for (const EffectParameter& own : effect.parameters) {
      if (&own == parameters[k] && (ranges[k].low > 0 || ranges[k].high < 0)) return true;
    }
  }
  return false;
}

/// Whether `after` is worth its numbers; the evidence and the reason stand in `candidate`.
bool accepted(const Evidence& evidence, const Fit& before, const Fit& after, Candidate& candidate) {
  if (!after.usable) {
    candidate.why = "the joint could not be simulated with it";
    return false;
  }
  const double floor2 = evidence.floor * evidence.floor;
  const Comparison drop = compare(evidence, before, after);
  candidate.held_out_rms = std::sqrt(after.by_factor.mean_square);
  candidate.margin = drop.t;
  candidate.delta_bic = bic_drop(evidence, before, after);
  const double gain = before.by_factor.mean_square - after.by_factor.mean_square;
  const double excess = std::max(1e-30, before.by_factor.mean_square - floor2);
  if (!(gain > std::pow(k_least_drop * evidence.floor, 2))) {
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

struct Trial {
  Fit fit;
  Candidate candidate;
};

bool lower(const Trial& a, const Trial& b) { return a.fit.by_factor.mean_square < b.fit.by_factor.mean_square; }

class Selector {
 public:
  Selector(const Evidence& evidence, Workers& workers, const std::function<void(const std::string&, double)>& progress)
      : evidence_(evidence), workers_(workers), progress_(progress) {}

  Selection run();

 private:
  std::vector<Trial> trials(const std::string& what, const std::vector<EffectSet>& added);
  Trial trial(Forward& forward, const EffectSet& added) const;
  std::vector<Trial> singles();
  std::optional<Trial> best_pair(const std::vector<Trial>& singles);
  bool grow();
  void find_rivals();
  bool exchange();
  void drop_needless();
  Fit without(Forward& forward, const Effect* effect, const Effect* instead) const;
  void note(const std::vector<Trial>& trials, const Trial* taken);

  bool at_floor(const Fit& fit) const { return fit.by_run.mean_square <= noise_limit(evidence_.floor); }
  bool has(const Effect& effect) const {
    const EffectSet& all = selection_.best.effects;
    return std::find(all.begin(), all.end(), &effect) != all.end();
  }
  void report(const std::string& what, double share) const {
    if (progress_) progress_(what, share);
  }

  const Evidence& evidence_;
  Workers& workers_;
  const std::function<void(const std::string&, double)>& progress_;
  Selection selection_;
};

Trial Selector::trial(Forward& forward, const EffectSet& added) const {
  Trial result;
  const Fit& before = selection_.best;
  EffectSet effects = before.effects;
  effects.insert(effects.end(), added.begin(), added.end());
  for (const Effect* effect : added) result.candidate.name += (result.candidate.name.empty() ? "" : " + ") + effect->name;
  result.fit = fit_effects(evidence_, forward, effects, before.at);
  bool holds = accepted(evidence_, before, result.fit, result.candidate);
  for (const Effect* effect : added) {
    if (!holds || excludes_zero(evidence_, result.fit, *effect)) continue;
    holds = false;
    result.candidate.why = "the interval of " + effect->name + " holds zero";
  }
  result.candidate.accepted = holds;
  return result;
}

/// Usable ones, the lowest held-out error first.
std::vector<Trial> Selector::trials(const std::string& what, const std::vector<EffectSet>& added) {
  std::vector<Trial> all(added.size());
  const double count = static_cast<double>(std::max<std::size_t>(1, added.size()));
  report(what, 0);
  workers_.each(added.size(), [&](Forward& forward, std::size_t i) { all[i] = trial(forward, added[i]); },
                [&](std::size_t done) { report(what, static_cast<double>(done) / count); });
  std::erase_if(all, [](const Trial& t) { return !t.fit.usable; });
  std::stable_sort(all.begin(), all.end(), lower);
  return all;
}

std::vector<Trial> Selector::singles() {
  std::vector<EffectSet> added;
  for (const Effect& effect : selection_.catalogue) {
    if (!has(effect)) added.push_back({&effect});
  }
  return trials("trying effects one by one", added);
}

/// Of pairs in which each is needed beside the other, the one that explains most.
std::optional<Trial> Selector::best_pair(const std::vector<Trial>& singles) {
  if (selection_.best.effects.size() + 2 > k_most_effects) return std::nullopt;
  std::vector<EffectSet> added;
  for (std::size_t i = 0; i < std::min(k_pair_leaders, singles.size()); ++i) {
    for (std::size_t j = i + 1; j < std::min(k_pair_seconds, singles.size()); ++j) {
      added.push_back({singles[i].fit.effects.back(), singles[j].fit.effects.back()});
    }
  }
  const auto alone = [&](const Effect* effect) -> const Fit& {
    return std::find_if(singles.begin(), singles.end(), [&](const Trial& t) { return t.fit.effects.back() == effect; })->fit;
  };
  for (Trial& pair : trials("trying effects in pairs", added)) {
    const EffectSet& effects = pair.fit.effects;
    Candidate scratch;
    const bool needed = pair.candidate.accepted && accepted(evidence_, alone(effects.back()), pair.fit, scratch) &&
                        accepted(evidence_, alone(effects[effects.size() - 2]), pair.fit, scratch);
    if (needed) return std::move(pair);
  }
  return std::nullopt;
}

void Selector::note(const std::vector<Trial>& trials, const Trial* taken) {
  for (const Trial& trial : trials) {
    if (&trial == taken) continue;
    Candidate candidate = trial.candidate;
    if (candidate.accepted && taken) candidate.why = taken->candidate.name + " explains more";
    candidate.accepted = false;
    selection_.tried.push_back(candidate);
  }
  if (taken) selection_.tried.push_back(taken->candidate);
}

/// Takes one effect more, or two that come together.
bool Selector::grow() {
  std::vector<Trial> alone = singles();
  const auto first = std::find_if(alone.begin(), alone.end(), [](const Trial& t) { return t.candidate.accepted; });
  std::optional<Trial> pair;
  if (first == alone.end() || !at_floor(first->fit)) pair = best_pair(alone);
  Candidate scratch;
  if (pair && first != alone.end() && !accepted(evidence_, first->fit, pair->fit, scratch)) pair.reset();
  if (pair) {
    note(alone, nullptr);
    pair->candidate.why = "neither explains as much alone";
    selection_.tried.push_back(pair->candidate);
    selection_.best = std::move(pair->fit);
    return true;
  }
  if (first == alone.end()) {
    note(alone, nullptr);
    return false;
  }
  first->candidate.why = "the held-out error falls by " + std::to_string(static_cast<int>(first->candidate.margin)) + " standard errors";
  note(alone, &*first);
  selection_.best = std::move(first->fit);
  return true;
}

Fit Selector::without(Forward& forward, const Effect* effect, const Effect* instead) const {
  EffectSet effects;
  Imperfections from = selection_.best.at;
  for (const Effect* other : selection_.best.effects) {
    if (other != effect) effects.push_back(other);
  }
  for (const EffectParameter& parameter : effect->parameters) from.*parameter.member = Imperfections{}.*parameter.member;
  if (instead) effects.push_back(instead);
  return fit_effects(evidence_, forward, effects, from);
}

void Selector::find_rivals() {
  selection_.rivals.clear();
  for (const Effect* effect : selection_.best.effects) {
    for (const Effect& rival : selection_.catalogue) {
      if (!has(rival)) selection_.rivals.push_back({effect, &rival, {}});
    }
  }
  const double count = static_cast<double>(std::max<std::size_t>(1, selection_.rivals.size()));
  workers_.each(
      selection_.rivals.size(),
      [&](Forward& forward, std::size_t i) {
        Rival& rival = selection_.rivals[i];
        rival.fit = without(forward, rival.accepted, rival.rival);
      },
      [&](std::size_t done) { report("holding rivals against what was found", static_cast<double>(done) / count); });
  std::erase_if(selection_.rivals, [](const Rival& rival) { return !rival.fit.usable; });
}

/// Lets the rival in that does better than the effect it stands for, if any does.
bool Selector::exchange() {
  const Rival* best = nullptr;
  for (const Rival& rival : selection_.rivals) {
    const double gain = selection_.best.by_factor.mean_square - rival.fit.by_factor.mean_square;
    const bool clearly = gain > k_same * evidence_.floor * evidence_.floor && excludes_zero(evidence_, rival.fit, *rival.rival);
    if (clearly && (best == nullptr || rival.fit.by_factor.mean_square < best->fit.by_factor.mean_square)) best = &rival;
  }
  if (best == nullptr) return false;
  Candidate candidate;
  candidate.name = best->accepted->name;
  candidate.held_out_rms = std::sqrt(selection_.best.by_factor.mean_square);
  candidate.why = best->rival->name + " does better in its place";
  selection_.tried.push_back(candidate);
  Fit better = best->fit;
  selection_.best = std::move(better);
  return true;
}

void Selector::drop_needless() {
  for (std::size_t i = 0; i < selection_.best.effects.size() && selection_.best.effects.size() > 1;) {
    const Effect* effect = selection_.best.effects[i];
    Fit fewer = without(workers_.one(), effect, nullptr);
    Candidate candidate;
    if (!fewer.usable || accepted(evidence_, fewer, selection_.best, candidate)) {
      ++i;
      continue;
    }
    candidate.name = effect->name;
    candidate.why = "needless beside the others";
    selection_.tried.push_back(candidate);
    selection_.best = std::move(fewer);
    i = 0;
  }
}

Selection Selector::run() {
  selection_.catalogue = catalogue(*evidence_.declared, evidence_.measurement);
  selection_.none = fit_effects(evidence_, workers_.one(), {}, {});
  selection_.best = selection_.none;
  if (!selection_.none.usable) return std::move(selection_);
  for (int exchanges = 0;;) {
    while (!at_floor(selection_.best) && selection_.best.effects.size() < k_most_effects && grow()) {
    }
    drop_needless();
    find_rivals();
    if (exchanges++ == k_most_exchanges || !exchange()) break;
  }
  return std::move(selection_);
}

}  // namespace

double noise_limit(double floor) { return (1.0 + k_least_drop * k_least_drop) * floor * floor; }

bool as_good(const Evidence& evidence, const Fit& rival, const Fit& best) {
  const Comparison worse = compare(evidence, rival, best);
  return worse.mean <= std::max(worse.standard_error, k_same * evidence.floor * evidence.floor);
}

Selection select_effects(const Evidence& evidence, Workers& workers, const std::function<void(const std::string&, double)>& progress) {
  return Selector(evidence, workers, progress).run();
}

}  // namespace fusee
