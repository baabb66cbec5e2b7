#include "calibration/selection.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "calibration/acceptance.h"
#include "calibration/catalogue.h"
#include "calibration/intervals.h"
#include "calibration/thresholds.h"

// Greedy, with a look one step further: causes come in pairs, of which neither may explain much alone, and a third that
// resembles both may explain more than either. So pairs are tried from the best few wherever the best single does not
// reach the noise; and once there is a set, every member is held against every effect in its place, and gives way where
// that does better. What is needless beside the others goes last.

namespace fusee {
namespace {

struct Trial {
  Fit fit;
  Candidate candidate;
};

/// Places of two among singles.
struct Pair {
  std::size_t one = 0;
  std::size_t other = 0;
};

/// A fit that is there, and what is tried beside it.
struct Addition {
  const Fit* base = nullptr;
  const Effect* effect = nullptr;
};

class Selector {
 public:
  Selector(const Evidence& evidence, Workers& workers, const CalibrationOptions& options)
      : evidence_(evidence), workers_(workers), options_(options) {}

  Selection run();

 private:
  void judge(const Fit& before, Trial& trial) const;
  std::vector<Trial> trials(const std::string& what, const std::vector<Addition>& added);
  const Trial* best_of(std::vector<Trial>& trials);
  std::vector<Trial> singles();
  std::vector<Pair> promising_pairs(const std::vector<Trial>& singles) const;
  std::optional<Trial> best_pair(const std::vector<Trial>& singles);
  bool grow();
  void find_rivals();
  bool exchange();
  void drop_needless();
  void retreat();
  Fit best_without(const Effect& effect);
  void note(const std::vector<Trial>& trials, const Trial* taken);

  /// Nothing is left to look for, and not because the joint is loose.
  bool is_done(const Fit& fit) const {
    return is_at_floor(fit, evidence_.floor) &&
           fit.price <= k_thresholds.dearest_play * evidence_.floor * evidence_.floor;
  }
  void report(const std::string& what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }

  const Evidence& evidence_;
  Workers& workers_;
  const CalibrationOptions& options_;
  Selection selection_;
};

/// Whether what was added to `before` is to be believed.
void Selector::judge(const Fit& before, Trial& trial) const {
  trial.candidate.name.clear();
  bool holds = accepted(evidence_, before, trial.fit, trial.candidate);
  for (std::size_t i = before.effects.size(); i < trial.fit.effects.size(); ++i) {
    const Effect& effect = *trial.fit.effects[i];
    trial.candidate.name += (trial.candidate.name.empty() ? "" : " + ") + effect.name;
    if (!holds || excludes_zero(evidence_, trial.fit, effect)) continue;
    holds = false;
    trial.candidate.why = "the interval of " + effect.name + " holds zero";
  }
  trial.candidate.accepted = holds;
}

/// One effect more than `base`, for each of `added`; usable ones, the lowest held-out error first.
std::vector<Trial> Selector::trials(const std::string& what, const std::vector<Addition>& added) {
  std::vector<Trial> all(added.size());
  const double count = static_cast<double>(std::max<std::size_t>(1, added.size()));
  report(what, 0);
  workers_.each(
      added.size(),
      [&](const Fitter& fitter, std::size_t i) {
        all[i].fit = fitter.with_effect(*added[i].base, *added[i].effect);
        judge(selection_.best, all[i]);
      },
      [&](std::size_t done) { report(what, static_cast<double>(done) / count); });
  std::erase_if(all, [](const Trial& t) { return !t.fit.usable; });
  std::stable_sort(all.begin(), all.end(),
                   [&](const Trial& a, const Trial& b) { return score(evidence_, a.fit) < score(evidence_, b.fit); });
  return all;
}

/// The first of `trials` that is still to be believed once it is fitted to the end. Of those that do as well, the one
/// of fewest numbers.
const Trial* Selector::best_of(std::vector<Trial>& trials) {
  const auto first =
      std::find_if(trials.begin(), trials.end(), [](const Trial& trial) { return trial.candidate.accepted; });
  if (first == trials.end()) return nullptr;
  auto simplest = first;
  for (auto it = first; it != trials.end(); ++it) {
    if (it->candidate.accepted && it->fit.x.size() < simplest->fit.x.size() && as_good(evidence_, it->fit, first->fit))
      simplest = it;
  }
  std::rotate(trials.begin(), simplest, simplest + 1);
  for (Trial& trial : trials) {
    if (!trial.candidate.accepted) continue;
    Fit settled = workers_.one().fit(trial.fit.effects, trial.fit.at);
    if (settled.usable) trial.fit = std::move(settled);
    judge(selection_.best, trial);
    if (trial.candidate.accepted) return &trial;
  }
  return nullptr;
}

std::vector<Trial> Selector::singles() {
  std::vector<Addition> added;
  for (const Effect* effect : selection_.catalogue) {
    if (!contains(selection_.best.effects, *effect)) added.push_back({&selection_.best, effect});
  }
  return trials("trying effects one by one", added);
}

/// What a linear look at a fit and its single additions needs: their slopes side by side, over the rows in use.
struct Directions {
  Eigen::MatrixXd gram;
  Eigen::VectorXd pull;             ///< of what the fit leaves
  std::vector<Eigen::Index> first;  ///< column of each single; the fit's own stand before the first of them
};

/// A single's directions are its slopes and the way it went.
Directions directions_of(const std::vector<Eigen::Index>& rows, const Fit& base, const std::vector<Trial>& singles) {
  Directions all;
  all.first = {base.x.size()};
  for (const Trial& single : singles) all.first.push_back(all.first.back() + single.fit.x.size() - base.x.size() + 1);
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(rows.size()), all.first.back());
  columns.leftCols(base.x.size()) = base.J(rows, Eigen::all);
  for (std::size_t i = 0; i < singles.size(); ++i) {
    const Fit& fit = singles[i].fit;
    const Eigen::Index own = fit.x.size() - base.x.size();
    columns.middleCols(all.first[i], own) = fit.J.rightCols(own)(rows, Eigen::all);
    columns.col(all.first[i] + own) = (base.residual - fit.residual)(rows);
  }
  all.gram = columns.transpose() * columns;
  all.pull = columns.transpose() * base.residual(rows);
  return all;
}

/// Squares that a linear fit of both would take away.
double promised_by(const Directions& all, const Pair& pair) {
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index k = 0; k < all.first.front(); ++k) chosen.push_back(k);
  for (const std::size_t single : {pair.one, pair.other}) {
    for (Eigen::Index k = all.first[single]; k < all.first[single + 1]; ++k) chosen.push_back(k);
  }
  Eigen::MatrixXd JJ = all.gram(chosen, chosen);
  JJ.diagonal() += 1e-9 * JJ.diagonal() + Eigen::VectorXd::Constant(JJ.rows(), 1e-300);
  const Eigen::VectorXd Jr = all.pull(chosen);
  return Jr.dot(JJ.ldlt().solve(Jr));
}

/// The best of all pairs of singles by what a linear fit of both would leave, the best first.
std::vector<Pair> Selector::promising_pairs(const std::vector<Trial>& singles) const {
  const Directions all = directions_of(evidence_.rows(), selection_.best, singles);
  std::vector<std::tuple<double, std::size_t, std::size_t>> ranked;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    for (std::size_t j = i + 1; j < singles.size(); ++j) ranked.emplace_back(-promised_by(all, {i, j}), i, j);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<Pair> pairs;
  for (const auto& [gain, i, j] : ranked) {
    if (pairs.size() < k_thresholds.most_pairs) pairs.push_back({i, j});
  }
  return pairs;
}

/// Of pairs in which each is needed beside the other, the one that explains most.
std::optional<Trial> Selector::best_pair(const std::vector<Trial>& singles) {
  if (selection_.best.effects.size() + 2 > k_thresholds.most_effects) return std::nullopt;
  std::vector<Addition> added;
  for (const Pair& pair : promising_pairs(singles))
    added.push_back({&singles[pair.one].fit, singles[pair.other].fit.effects.back()});
  const auto alone = [&](const Effect* effect) -> const Fit& {
    return std::find_if(singles.begin(), singles.end(), [&](const Trial& t) { return t.fit.effects.back() == effect; })
        ->fit;
  };
  std::vector<Trial> pairs = trials("trying effects in pairs", added);
  std::erase_if(pairs, [&](const Trial& pair) {
    const EffectSet& effects = pair.fit.effects;
    Candidate scratch;
    return !pair.candidate.accepted || !accepted(evidence_, alone(effects.back()), pair.fit, scratch) ||
           !accepted(evidence_, alone(effects[effects.size() - 2]), pair.fit, scratch);
  });
  const Trial* best = best_of(pairs);
  if (best == nullptr) return std::nullopt;
  return *best;
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
  const Trial* first = best_of(alone);
  std::optional<Trial> pair;
  if (first == nullptr || !is_done(first->fit)) pair = best_pair(alone);
  Candidate scratch;
  if (pair && first != nullptr && !accepted(evidence_, first->fit, pair->fit, scratch)) pair.reset();
  if (pair) {
    note(alone, nullptr);
    pair->candidate.why = "neither explains as much alone";
    selection_.tried.push_back(pair->candidate);
    selection_.best = std::move(pair->fit);
    return true;
  }
  note(alone, first);
  if (first == nullptr) return false;
  selection_.tried.back().why =
      "the held-out error falls by " + std::to_string(static_cast<int>(first->candidate.margin)) + " standard errors";
  Fit best = first->fit;
  selection_.best = std::move(best);
  return true;
}

Fit Selector::best_without(const Effect& effect) {
  return workers_.one().fit(without(selection_.best.effects, effect), without(selection_.best.at, effect));
}

/// Every effect in the place of every accepted one; those that come near are fitted to the end.
void Selector::find_rivals() {
  selection_.rivals.clear();
  std::vector<Fit> bases;
  for (const Effect* effect : selection_.best.effects) bases.push_back(best_without(*effect));
  std::vector<Addition> added;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    for (const Effect* rival : selection_.catalogue) {
      if (contains(selection_.best.effects, *rival) || !bases[i].usable) continue;
      selection_.rivals.push_back({selection_.best.effects[i], rival, {}});
      added.push_back({&bases[i], rival});
    }
  }
  const double count = static_cast<double>(std::max<std::size_t>(1, added.size()));
  const double near =
      k_thresholds.near * std::max(selection_.best.by_factor.mean_square, evidence_.floor * evidence_.floor);
  workers_.each(
      added.size(),
      [&](const Fitter& fitter, std::size_t i) {
        Fit& fit = selection_.rivals[i].fit;
        fit = fitter.with_effect(*added[i].base, *added[i].effect);
        if (fit.usable && fit.by_factor.mean_square < near) fit = fitter.fit(fit.effects, fit.at);
      },
      [&](std::size_t done) { report("holding rivals against what was found", static_cast<double>(done) / count); });
  std::erase_if(selection_.rivals, [](const Rival& rival) { return !rival.fit.usable; });
}

/// Lets the rival in that does better than the effect it stands for, if any does.
bool Selector::exchange() {
  const Rival* best = nullptr;
  for (const Rival& rival : selection_.rivals) {
    const double gain = score(evidence_, selection_.best) - score(evidence_, rival.fit);
    const bool clearly = gain > k_thresholds.better * evidence_.floor * evidence_.floor &&
                         excludes_zero(evidence_, rival.fit, *rival.rival);
    if (clearly && (best == nullptr || score(evidence_, rival.fit) < score(evidence_, best->fit))) best = &rival;
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
    Fit fewer = best_without(*effect);
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

/// Part of an error that stays unexplained is no explanation.
void Selector::retreat() {
  const double floor2 = evidence_.floor * evidence_.floor;
  const double all = selection_.none.by_run.mean_square - floor2;
  const double left = selection_.best.by_run.mean_square - floor2;
  const bool walks = is_walking(stroke_scatter(evidence_, selection_.best));
  if (!walks && is_done(selection_.best)) return;
  if (left <= (1.0 - (walks ? k_thresholds.most_of_what_walks : k_thresholds.most_of_it)) * all) return;
  for (const Effect* effect : selection_.best.effects) {
    Candidate candidate;
    candidate.name = effect->name;
    candidate.held_out_rms = std::sqrt(selection_.best.by_factor.mean_square);
    candidate.why = "it resembles a part of what is there, and the rest has another cause";
    selection_.tried.push_back(candidate);
  }
  selection_.best = selection_.none;
  selection_.rivals.clear();
}

Selection Selector::run() {
  selection_.catalogue =
      catalogue(*evidence_.declared, evidence_.measurement, options_.more_effects, options_.without);
  selection_.none = workers_.one().fit({}, {});
  selection_.best = selection_.none;
  if (!selection_.none.usable) return std::move(selection_);
  for (int exchanges = 0;;) {
    while (!is_done(selection_.best) && selection_.best.effects.size() < k_thresholds.most_effects && grow()) {
    }
    drop_needless();
    find_rivals();
    if (exchanges++ == k_thresholds.most_exchanges || !exchange()) break;
  }
  retreat();
  return std::move(selection_);
}

}  // namespace

Selection select_effects(const Evidence& evidence, Workers& workers, const CalibrationOptions& options) {
  return Selector(evidence, workers, options).run();
}

}  // namespace fusee
