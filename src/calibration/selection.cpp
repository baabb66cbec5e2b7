#include "calibration/selection.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

// Greedy, with a look one step further: causes come in pairs, of which neither may explain much alone, and a third that
// resembles both may explain more than either. So pairs are tried from the best few wherever the best single does not
// reach the noise; and once there is a set, every member is held against every effect in its place, and gives way where
// that does better. What is needless beside the others goes last.

namespace fusee {
namespace {

/// An effect smaller than this part of the noise floor is not worth a name: the model's own error may be as large.
constexpr double k_least_drop = 0.5;
/// A cause explains a good part of what stands above the floor; what explains a small part of it is the neighbour of a
/// cause unknown.
constexpr double k_least_share = 0.30;
constexpr double k_least_bic_drop = 6.0;
/// A rival takes an effect's place if it does better by this part of the floor's square.
constexpr double k_better = 0.03;
/// Strokes that should be alike are apart by this part of the noise within them: the joint does not repeat.
constexpr double k_walks = 0.7;
/// A joint that is loose nearly everywhere explains everything: play that costs more than this is no explanation. In
/// squares of the floor.
constexpr double k_dearest_play = 2.0;
/// What was measured by hand speaks against an explanation that is off by three standard uncertainties.
constexpr double k_contradicted = 9.0;
/// Where structure is left, what was found must have taken this share of all there was: else it is the neighbour of a
/// cause unknown.
constexpr double k_most_of_it = 0.80;
constexpr double k_most_of_what_walks = 0.95;
constexpr std::size_t k_most_effects = 5;
constexpr std::size_t k_most_pairs = 10;
constexpr int k_most_exchanges = 4;
/// A rival whose held-out error is within this of the best may be as good once it is fitted to the end.
constexpr double k_near = 2.0;

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

/// Held-out mean square error, a caliper's reading counted as a row.
double score(const Evidence& evidence, const Fit& fit) {
  const double rows = static_cast<double>(std::max<std::size_t>(1, evidence.rows_used()));
  return fit.by_factor.mean_square + evidence.floor * evidence.floor * fit.against_readings / rows;
}

struct Trial {
  Fit fit;
  Candidate candidate;
};

/// A fit that is there, and what is tried beside it.
struct Addition {
  const Fit* base = nullptr;
  const Effect* effect = nullptr;
};

class Selector {
 public:
  Selector(const Evidence& evidence, Workers& workers, const std::function<void(const std::string&, double)>& progress)
      : evidence_(evidence), workers_(workers), progress_(progress) {}

  Selection run();

 private:
  void judge(const Fit& before, Trial& trial) const;
  std::vector<Trial> trials(const std::string& what, const std::vector<Addition>& added);
  const Trial* best_of(std::vector<Trial>& trials);
  std::vector<Trial> singles();
  std::vector<std::pair<const Trial*, const Trial*>> promising_pairs(const std::vector<Trial>& singles) const;
  std::optional<Trial> best_pair(const std::vector<Trial>& singles);
  bool grow();
  void find_rivals();
  bool exchange();
  void drop_needless();
  void retreat();
  Fit without(const Effect* effect);
  void note(const std::vector<Trial>& trials, const Trial* taken);

  bool at_floor(const Fit& fit) const {
    const double floor2 = evidence_.floor * evidence_.floor;
    return fit.by_run.mean_square - fit.price <= noise_limit(evidence_.floor) && fit.price <= k_dearest_play * floor2;
  }
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
      [&](Forward& forward, std::size_t i) {
        all[i].fit = with_effect(evidence_, forward, *added[i].base, *added[i].effect);
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
    Fit settled = fit_effects(evidence_, workers_.one(), trial.fit.effects, trial.fit.at);
    if (settled.usable) trial.fit = std::move(settled);
    judge(selection_.best, trial);
    if (trial.candidate.accepted) return &trial;
  }
  return nullptr;
}

std::vector<Trial> Selector::singles() {
  std::vector<Addition> added;
  for (const Effect& effect : selection_.catalogue) {
    if (!has(effect)) added.push_back({&selection_.best, &effect});
  }
  return trials("trying effects one by one", added);
}

/// All pairs of singles by what a linear fit of both would leave, the best first. A single's directions are its slopes
/// and the way it went.
std::vector<std::pair<const Trial*, const Trial*>> Selector::promising_pairs(const std::vector<Trial>& singles) const {
  const Fit& base = selection_.best;
  std::vector<Eigen::Index> rows;
  for (const Block& block : evidence_.blocks) {
    for (const std::size_t row : block.rows) rows.push_back(static_cast<Eigen::Index>(row));
  }
  std::vector<Eigen::Index> first{base.x.size()};
  for (const Trial& single : singles) first.push_back(first.back() + single.fit.x.size() - base.x.size() + 1);
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(rows.size()), first.back());
  columns.leftCols(base.x.size()) = base.J(rows, Eigen::all);
  for (std::size_t i = 0; i < singles.size(); ++i) {
    const Fit& fit = singles[i].fit;
    const Eigen::Index own = fit.x.size() - base.x.size();
    columns.middleCols(first[i], own) = fit.J.rightCols(own)(rows, Eigen::all);
    columns.col(first[i] + own) = (base.residual - fit.residual)(rows);
  }
  const Eigen::MatrixXd gram = columns.transpose() * columns;
  const Eigen::VectorXd pull = columns.transpose() * base.residual(rows);
  std::vector<std::tuple<double, std::size_t, std::size_t>> ranked;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    for (std::size_t j = i + 1; j < singles.size(); ++j) {
      std::vector<Eigen::Index> chosen;
      for (Eigen::Index k = 0; k < base.x.size(); ++k) chosen.push_back(k);
      for (const std::size_t single : {i, j}) {
        for (Eigen::Index k = first[single]; k < first[single + 1]; ++k) chosen.push_back(k);
      }
      Eigen::MatrixXd JJ = gram(chosen, chosen);
      JJ.diagonal() += 1e-9 * JJ.diagonal() + Eigen::VectorXd::Constant(JJ.rows(), 1e-300);
      const Eigen::VectorXd Jr = pull(chosen);
      ranked.emplace_back(-Jr.dot(JJ.ldlt().solve(Jr)), i, j);
    }
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::pair<const Trial*, const Trial*>> pairs;
  for (const auto& [gain, i, j] : ranked) {
    if (pairs.size() < k_most_pairs) pairs.emplace_back(&singles[i], &singles[j]);
  }
  return pairs;
}

/// Of pairs in which each is needed beside the other, the one that explains most.
std::optional<Trial> Selector::best_pair(const std::vector<Trial>& singles) {
  if (selection_.best.effects.size() + 2 > k_most_effects) return std::nullopt;
  std::vector<Addition> added;
  for (const auto& [one, other] : promising_pairs(singles)) added.push_back({&one->fit, other->fit.effects.back()});
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
  if (first == nullptr || !at_floor(first->fit)) pair = best_pair(alone);
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

Fit Selector::without(const Effect* effect) {
  EffectSet effects;
  Imperfections from = selection_.best.at;
  for (const Effect* other : selection_.best.effects) {
    if (other != effect) effects.push_back(other);
  }
  for (const EffectParameter& parameter : effect->parameters)
    from.*parameter.member = Imperfections{}.*parameter.member;
  return fit_effects(evidence_, workers_.one(), effects, from);
}

/// Every effect in the place of every accepted one; those that come near are fitted to the end.
void Selector::find_rivals() {
  selection_.rivals.clear();
  std::vector<Fit> bases;
  for (const Effect* effect : selection_.best.effects) bases.push_back(without(effect));
  std::vector<Addition> added;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    for (const Effect& rival : selection_.catalogue) {
      if (has(rival) || !bases[i].usable) continue;
      selection_.rivals.push_back({selection_.best.effects[i], &rival, {}});
      added.push_back({&bases[i], &rival});
    }
  }
  const double count = static_cast<double>(std::max<std::size_t>(1, added.size()));
  const double near = k_near * std::max(selection_.best.by_factor.mean_square, evidence_.floor * evidence_.floor);
  workers_.each(
      added.size(),
      [&](Forward& forward, std::size_t i) {
        Fit& fit = selection_.rivals[i].fit;
        fit = with_effect(evidence_, forward, *added[i].base, *added[i].effect);
        if (fit.usable && fit.by_factor.mean_square < near) fit = fit_effects(evidence_, forward, fit.effects, fit.at);
      },
      [&](std::size_t done) { report("holding rivals against what was found", static_cast<double>(done) / count); });
  std::erase_if(selection_.rivals, [](const Rival& rival) { return !rival.fit.usable; });
}

/// Lets the rival in that does better than the effect it stands for, if any does.
bool Selector::exchange() {
  const Rival* best = nullptr;
  for (const Rival& rival : selection_.rivals) {
    const double gain = score(evidence_, selection_.best) - score(evidence_, rival.fit);
    const bool clearly =
        gain > k_better * evidence_.floor * evidence_.floor && excludes_zero(evidence_, rival.fit, *rival.rival);
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
    Fit fewer = without(effect);
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
  if (!walks && at_floor(selection_.best)) return;
  if (left <= (1.0 - (walks ? k_most_of_what_walks : k_most_of_it)) * all) return;
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
  retreat();
  return std::move(selection_);
}

}  // namespace

double noise_limit(double floor) { return (1.0 + k_least_drop * k_least_drop) * floor * floor; }

bool as_good(const Evidence& evidence, const Fit& rival, const Fit& best) {
  if (rival.against_readings > best.against_readings + k_contradicted) return false;
  const Comparison worse = compare(evidence, rival, best);
  return worse.mean <= std::max(worse.standard_error, std::pow(k_least_drop * evidence.floor, 2));
}

bool is_walking(const StrokeScatter& scatter) { return scatter.between > k_walks * scatter.within; }

Selection select_effects(const Evidence& evidence, Workers& workers,
                         const std::function<void(const std::string&, double)>& progress) {
  return Selector(evidence, workers, progress).run();
}

}  // namespace fusee
