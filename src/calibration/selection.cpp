#include "calibration/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "calibration/catalogue.h"
#include "calibration/thresholds.h"

// A beam over sets of effects. A set is as good as its evidence, beside a discrepancy that may take any smooth shape,
// and as its effects are common; the best set ever seen is what is looked at closely. A wider set is first looked at by
// the slopes that each effect had alone and by chords beside what is there, and fitted only if either promises
// something. Once nothing is gained, every member is left out and held against every effect in its place; and once
// that gains nothing either, one or two others are tried in the place of none, one or two members: a slip and an offset
// imitated slack and a wave and a lever's length a profile, and no single exchange that was looked at led from one to
// the other. Then all sets ever seen are weighed together: a member stands if it, or what stands in its place
// elsewhere, is in nearly all of the weight.

namespace fusee {
namespace {

/// Of amplitudes, in a linear look.
constexpr int k_look_rounds = 4;

/// What an effect adds to a linear look: slopes over the rows in use.
struct Look {
  Eigen::MatrixXd J;
  Eigen::VectorXd prior;
};

/// A fit that is there, and what is tried beside it.
struct Addition {
  const Fit* base = nullptr;
  const Effect* effect = nullptr;
  double promise = 0;
  Look look = {};  ///< by which it is promised
};

/// Two effects beside a base.
struct PairBeside {
  std::size_t base = 0;
  const Addition* one = nullptr;
  const Addition* other = nullptr;
  double promise = 0;
};

/// Looks beside a base: what is summed over rows is summed once for all sets of them.
class SharedLooks {
 public:
  SharedLooks(const Evidence& evidence, const Fit& base, const std::vector<const Look*>& looks)
      : marginal_(*evidence.marginal) {
    Tangent tangent = tangent_of(evidence, base);
    own_ = tangent.x.size();
    for (const Look* look : looks) {
      first_.push_back(tangent.J.cols());
      add(*look, tangent);
    }
    first_.push_back(tangent.J.cols());
    all_ = marginal_.sums_of(tangent);
    beside_ = marginal_.sized(base.explained.amplitudes, tangent.give);
  }

  /// With the base's discrepancy beside them; `chosen`: places in the looks.
  double log_evidence(const std::vector<std::size_t>& chosen) const {
    std::vector<Eigen::Index> columns(static_cast<std::size_t>(own_));
    std::iota(columns.begin(), columns.end(), 0);
    for (const std::size_t i : chosen) {
      for (Eigen::Index k = first_[i]; k < first_[i + 1]; ++k) columns.push_back(k);
    }
    TangentSums sums = all_;
    sums.JJ = all_.JJ(columns, columns);
    sums.JD = all_.JD(columns, Eigen::all);
    sums.Jr = all_.Jr(columns);
    sums.x = all_.x(columns);
    sums.prior = all_.prior(columns);
    sums.read = all_.read(columns, columns);
    sums.pull = all_.pull(columns);
    return marginal_.at(sums, beside_).log_evidence;
  }

  /// One look more, where it does nothing.
  static void add(const Look& look, Tangent& tangent) {
    const Eigen::Index before = tangent.x.size();
    const Eigen::Index all = before + look.J.cols();
    tangent.J.conservativeResize(Eigen::NoChange, all);
    tangent.J.rightCols(look.J.cols()) = look.J;
    tangent.x.conservativeResize(all);
    tangent.x.tail(look.J.cols()).setZero();
    tangent.prior.conservativeResize(all);
    tangent.prior.tail(look.J.cols()) = look.prior;
    Eigen::MatrixXd read = Eigen::MatrixXd::Zero(all, all);
    read.topLeftCorner(before, before) = tangent.read;
    tangent.read = read;
    tangent.pull.conservativeResize(all);
    tangent.pull.tail(look.J.cols()).setZero();
  }

 private:
  const Marginal& marginal_;
  TangentSums all_;
  SizedDiscrepancy beside_;
  Eigen::Index own_ = 0;
  std::vector<Eigen::Index> first_;  ///< column of each look, and the end
};

class Selector {
 public:
  Selector(const Evidence& evidence, Workers& workers, const CalibrationOptions& options)
      : evidence_(evidence), workers_(workers), options_(options) {}

  Selection run();

 private:
  using Key = std::vector<std::size_t>;
  Key key_of(const EffectSet& effects) const;
  void keep(Fit fit);
  std::vector<const Fit*> ranked() const;
  double promised(const Fit& base, const EffectSet& added, const std::vector<const Look*>& looks, int rounds) const;
  std::vector<Look> looks_beside(const Fitter& fitter, const Fit& base, const Effect& effect) const;
  std::vector<Fit> fitted(const std::string& what, const std::vector<Addition>& added);
  void try_singles();
  void try_pairs();
  bool widen();
  void settle_best();
  std::vector<Addition> promising(const Fitter& fitter, const Fit& base, std::size_t most) const;
  bool challenge();
  std::vector<Fit> reduced() const;
  std::vector<PairBeside> pairs_beside(const Fit& base, std::size_t place, const std::vector<Addition>& looks) const;
  bool exchange();
  std::vector<Weighed> weighed();
  void look_at_spread();
  bool is_without_size(const Effect& effect) const;
  bool drop_doubtful();
  void write_down();

  void report(const std::string& what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }
  std::size_t place_of(const Effect& effect) const {
    return static_cast<std::size_t>(std::find(selection_.catalogue.begin(), selection_.catalogue.end(), &effect) -
                                    selection_.catalogue.begin());
  }

  const Evidence& evidence_;
  Workers& workers_;
  const CalibrationOptions& options_;
  Selection selection_;
  std::vector<Look> looks_;  ///< of each effect of the catalogue; empty where it cannot be simulated
  std::map<Key, Fit> seen_;
};

Selector::Key Selector::key_of(const EffectSet& effects) const {
  Key key;
  for (const Effect* effect : effects) key.push_back(place_of(*effect));
  std::sort(key.begin(), key.end());
  return key;
}

void Selector::keep(Fit fit) {
  if (!fit.usable) return;
  const auto [place, added] = seen_.try_emplace(key_of(fit.effects), fit);
  if (!added && fit.log_evidence > place->second.log_evidence) place->second = std::move(fit);
}

std::vector<const Fit*> Selector::ranked() const {
  std::vector<const Fit*> all;
  for (const auto& [key, fit] : seen_) all.push_back(&fit);
  std::stable_sort(all.begin(), all.end(), [](const Fit* a, const Fit* b) { return score(*a) > score(*b); });
  return all;
}

std::vector<Fit> Selector::fitted(const std::string& what, const std::vector<Addition>& added) {
  std::vector<Fit> fits(added.size());
  const double count = static_cast<double>(std::max<std::size_t>(1, added.size()));
  report(what, 0);
  workers_.each(
      added.size(),
      [&](const Fitter& fitter, std::size_t i) { fits[i] = fitter.with_effect(*added[i].base, *added[i].effect); },
      [&](std::size_t done) { report(what, static_cast<double>(done) / count); });
  return fits;
}

void Selector::try_singles() {
  std::vector<Addition> added;
  for (const Effect* effect : selection_.catalogue) added.push_back({&selection_.none, effect});
  std::vector<Fit> fits = fitted("trying effects one by one", added);
  const Eigen::Index own = selection_.none.x.size();
  for (Fit& fit : fits) {
    Look look;
    if (fit.usable) {
      const Tangent tangent = tangent_of(evidence_, fit);
      const Eigen::Index more = fit.x.size() - own;
      look.J = tangent.J.rightCols(more);
      look.prior = tangent.prior.tail(more);
      // Of a single number the chord from nothing says more than the slope at its end.
      if (more == 1 && fit.x[own] != 0)
        look.J.col(0) = (tangent_of(evidence_, selection_.none).residual - tangent.residual) / fit.x[own];
    }
    looks_.push_back(std::move(look));
    keep(std::move(fit));
  }
}

/// Score of `base` with these effects by a linear look.
double Selector::promised(const Fit& base, const EffectSet& added, const std::vector<const Look*>& looks,
                          int rounds) const {
  Tangent tangent = tangent_of(evidence_, base);
  double cost = base.log_evidence - score(base);
  for (const Effect* effect : added) cost += rareness_of(*effect);
  for (const Look* of_one : looks) {
    if (of_one->J.size() == 0) return -std::numeric_limits<double>::infinity();
    SharedLooks::add(*of_one, tangent);
  }
  const double loose = base.explained.log_evidence - base.log_evidence;
  return evidence_.marginal->best(tangent, base.explained.amplitudes, rounds).log_evidence - loose - cost;
}

/// The best of all pairs by a linear look.
void Selector::try_pairs() {
  struct Pair {
    double promise;
    std::size_t one, other;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    for (std::size_t j = i + 1; j < looks_.size(); ++j) pairs.push_back({0, i, j});
  }
  const auto look_at = [&](int rounds) {
    workers_.each(pairs.size(), [&](const Fitter&, std::size_t k) {
      const std::size_t one = pairs[k].one, other = pairs[k].other;
      pairs[k].promise = promised(selection_.none, {selection_.catalogue[one], selection_.catalogue[other]},
                                  {&looks_[one], &looks_[other]}, rounds);
    });
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.promise > b.promise; });
  };
  look_at(1);
  pairs.resize(std::min(pairs.size(), k_thresholds.most_looks_at_pairs));
  look_at(k_look_rounds);
  std::vector<Addition> added;
  for (const Pair& pair : pairs) {
    const auto base = seen_.find({pair.one});
    if (added.size() == k_thresholds.most_pairs || base == seen_.end()) continue;
    added.push_back({&base->second, selection_.catalogue[pair.other], pair.promise});
  }
  std::vector<Fit> fits = fitted("trying effects in pairs", added);
  for (Fit& fit : fits) keep(std::move(fit));
}

/// By chords over the effect's size in practice, and to each of its starts.
std::vector<Look> Selector::looks_beside(const Fitter& fitter, const Fit& base, const Effect& effect) const {
  std::vector<Look> looks;
  for (const Fit& wider : fitter.with_chords_of_starts(base, effect)) {
    if (!wider.usable) continue;
    const Tangent tangent = tangent_of(evidence_, wider);
    const Eigen::Index more = wider.x.size() - base.x.size();
    looks.push_back({tangent.J.rightCols(more), tangent.prior.tail(more)});
  }
  return looks;
}

/// Effects beside `base`, by a linear look the best first.
std::vector<Addition> Selector::promising(const Fitter& fitter, const Fit& base, std::size_t most) const {
  EffectSet effects = selection_.catalogue;
  std::erase_if(effects, [&](const Effect* effect) { return contains(base.effects, *effect); });
  std::vector<std::vector<Look>> looks(effects.size());
  std::vector<const Look*> flat;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    looks[i] = looks_beside(fitter, base, *effects[i]);
    for (const Look& look : looks[i]) flat.push_back(&look);
  }
  const SharedLooks shared(evidence_, base, flat);
  std::vector<Addition> all;
  std::size_t place = 0;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Look& alone = looks_[place_of(*effects[i])];
    Addition best{&base, effects[i], promised(base, {effects[i]}, {&alone}, k_look_rounds), alone};
    double most_likely = -std::numeric_limits<double>::infinity();
    const Look* likeliest = nullptr;
    for (const Look& look : looks[i]) {
      const double likely = shared.log_evidence({place++});
      if (likely > most_likely) most_likely = likely, likeliest = &look;
    }
    const double promise =
        likeliest == nullptr ? most_likely : promised(base, {effects[i]}, {likeliest}, k_look_rounds);
    if (promise > best.promise) best.promise = promise, best.look = *likeliest;
    all.push_back(std::move(best));
  }
  std::stable_sort(all.begin(), all.end(), [](const Addition& a, const Addition& b) { return a.promise > b.promise; });
  all.resize(std::min(all.size(), most));
  return all;
}

/// Whether a wider set than those of the beam does better than the best so far.
bool Selector::widen() {
  std::vector<const Fit*> beam = ranked();
  beam.resize(std::min(beam.size(), k_thresholds.beam));
  const double before = score(*beam.front());
  std::vector<std::vector<Addition>> looks(beam.size());
  workers_.each(beam.size(), [&](const Fitter& fitter, std::size_t i) {
    if (beam[i]->effects.size() < k_thresholds.most_effects)
      looks[i] = promising(fitter, *beam[i], k_thresholds.most_looks);
  });
  std::vector<Addition> added;
  for (const std::vector<Addition>& look : looks) {
    for (const Addition& addition : look) {
      EffectSet effects = addition.base->effects;
      effects.push_back(addition.effect);
      if (addition.promise > before - k_thresholds.hopeless && !seen_.count(key_of(effects))) added.push_back(addition);
    }
  }
  std::vector<Fit> fits = fitted("trying wider sets of effects", added);
  for (Fit& fit : fits) keep(std::move(fit));
  return score(*ranked().front()) > before;
}

/// The best few are fitted to the end.
void Selector::settle_best() {
  std::vector<const Fit*> all = ranked();
  all.resize(std::min(all.size(), k_thresholds.beam));
  std::vector<Fit> settled(all.size());
  workers_.each(all.size(),
                [&](const Fitter& fitter, std::size_t i) { settled[i] = fitter.fit(all[i]->effects, all[i]->at); });
  for (Fit& fit : settled) keep(std::move(fit));
  const Fit* likeliest = ranked().front();
  selection_.best = workers_.one().fit(likeliest->effects, likeliest->at);
  if (!selection_.best.usable || selection_.best.log_evidence < likeliest->log_evidence) selection_.best = *likeliest;
}

/// Every member is left out, and held against every effect in its place. Whether a better set was found.
bool Selector::challenge() {
  const Fit& best = selection_.best;
  selection_.without.assign(best.effects.size(), {});
  workers_.each(best.effects.size(), [&](const Fitter& fitter, std::size_t i) {
    const Effect& effect = *best.effects[i];
    selection_.without[i] = fitter.fit(without(best.effects, effect), without(best.at, effect));
  });
  std::vector<std::vector<Addition>> looks(best.effects.size());
  workers_.each(best.effects.size(), [&](const Fitter& fitter, std::size_t i) {
    if (selection_.without[i].usable) looks[i] = promising(fitter, selection_.without[i], selection_.catalogue.size());
  });
  selection_.rivals.clear();
  std::vector<Addition> added;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    std::size_t taken = 0;
    for (const Addition& addition : looks[i]) {
      const bool hopeless = addition.promise < score(best) - k_thresholds.hopeless;
      if (contains(best.effects, *addition.effect) || hopeless || taken++ >= k_thresholds.most_rivals) continue;
      selection_.rivals.push_back({best.effects[i], addition.effect, {}});
      added.push_back(addition);
    }
  }
  report("holding rivals against what was found", 0);
  workers_.each(added.size(), [&](const Fitter& fitter, std::size_t i) {
    Fit& fit = selection_.rivals[i].fit;
    fit = fitter.with_effect(*added[i].base, *added[i].effect);
    if (fit.usable && fit.log_evidence > best.log_evidence - 3.0 * k_thresholds.as_good)
      fit = fitter.fit(fit.effects, fit.at);
  });
  std::erase_if(selection_.rivals, [](const Rival& rival) { return !rival.fit.usable; });
  const double before = score(best);
  for (const Fit& fit : selection_.without) keep(fit);
  for (const Rival& rival : selection_.rivals) keep(rival.fit);
  return score(*ranked().front()) > before + k_thresholds.better;
}

/// The best without one or two of its members, the likeliest first.
std::vector<Fit> Selector::reduced() const {
  const Fit& best = selection_.best;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < best.effects.size(); ++i) {
    for (std::size_t j = i + 1; j < best.effects.size(); ++j) pairs.emplace_back(i, j);
  }
  std::vector<Fit> all(pairs.size());
  workers_.each(pairs.size(), [&](const Fitter& fitter, std::size_t k) {
    const Effect& one = *best.effects[pairs[k].first];
    const Effect& other = *best.effects[pairs[k].second];
    all[k] = fitter.fit(without(without(best.effects, one), other), without(without(best.at, one), other));
  });
  all.insert(all.end(), selection_.without.begin(), selection_.without.end());
  all.push_back(best);
  std::erase_if(all, [](const Fit& fit) { return !fit.usable; });
  std::stable_sort(all.begin(), all.end(), [](const Fit& a, const Fit& b) { return score(a) > score(b); });
  all.resize(std::min(all.size(), k_thresholds.most_reduced));
  return all;
}

/// The best of all pairs of `looks` by a linear look, sets that were not looked at.
std::vector<PairBeside> Selector::pairs_beside(const Fit& base, std::size_t place,
                                               const std::vector<Addition>& looks) const {
  std::vector<const Look*> usable;
  std::vector<const Addition*> owners;
  for (const Addition& addition : looks) {
    if (addition.look.J.size() == 0) continue;
    usable.push_back(&addition.look);
    owners.push_back(&addition);
  }
  const SharedLooks shared(evidence_, base, usable);
  std::vector<PairBeside> pairs;
  for (std::size_t i = 0; i < owners.size(); ++i) {
    for (std::size_t j = i + 1; j < owners.size(); ++j) {
      EffectSet effects = base.effects;
      effects.insert(effects.end(), {owners[i]->effect, owners[j]->effect});
      if (seen_.count(key_of(effects))) continue;
      const double cost = rareness_of(*owners[i]->effect) + rareness_of(*owners[j]->effect);
      pairs.push_back({place, owners[i], owners[j], shared.log_evidence({i, j}) - cost});
    }
  }
  const auto keep_best = [&](std::size_t most) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const PairBeside& a, const PairBeside& b) { return a.promise > b.promise; });
    pairs.resize(std::min(pairs.size(), most));
  };
  keep_best(k_thresholds.most_looks_instead);
  for (PairBeside& pair : pairs)
    pair.promise =
        promised(base, {pair.one->effect, pair.other->effect}, {&pair.one->look, &pair.other->look}, k_look_rounds);
  keep_best(k_thresholds.most_instead);
  return pairs;
}

/// One or two others in the place of none, one or two members: what takes two exchanges at once, since either alone is
/// worse. Whether a better set was found.
bool Selector::exchange() {
  const double before = score(selection_.best);
  const std::vector<Fit> bases = reduced();
  std::vector<std::vector<Addition>> looks(bases.size());
  workers_.each(bases.size(), [&](const Fitter& fitter, std::size_t i) {
    if (bases[i].effects.size() < k_thresholds.most_effects)
      looks[i] = promising(fitter, bases[i], selection_.catalogue.size());
  });
  std::vector<std::vector<PairBeside>> pairs(bases.size());
  workers_.each(bases.size(), [&](const Fitter&, std::size_t i) {
    if (bases[i].effects.size() + 2 <= k_thresholds.most_effects) pairs[i] = pairs_beside(bases[i], i, looks[i]);
  });
  std::vector<Addition> singles;
  std::vector<PairBeside> both;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    for (std::size_t k = 0; k < std::min(looks[i].size(), k_thresholds.most_instead); ++k) {
      EffectSet effects = bases[i].effects;
      effects.push_back(looks[i][k].effect);
      if (looks[i][k].promise > before - k_thresholds.hopeless && !seen_.count(key_of(effects)))
        singles.push_back(looks[i][k]);
    }
    for (const PairBeside& pair : pairs[i]) {
      if (pair.promise > before - k_thresholds.hopeless) both.push_back(pair);
    }
  }
  std::vector<Fit> fits = fitted("exchanging effects", singles);
  std::vector<Fit> wider(both.size());
  workers_.each(both.size(), [&](const Fitter& fitter, std::size_t k) {
    const Fit one = fitter.with_effect(bases[both[k].base], *both[k].one->effect);
    if (one.usable) wider[k] = fitter.with_effect(one, *both[k].other->effect);
  });
  for (Fit& fit : fits) keep(std::move(fit));
  for (Fit& fit : wider) keep(std::move(fit));
  return score(*ranked().front()) > before + k_thresholds.better;
}

/// Whether all its numbers may as well be nothing.
bool has_no_size(const Fit& fit, const Effect& effect, double temperature) {
  std::vector<Eigen::Index> own;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const bool is_own = std::any_of(effect.parameters.begin(), effect.parameters.end(),
                                    [&](const EffectParameter& p) { return &p == fit.parameters[k]; });
    if (is_own) own.push_back(static_cast<Eigen::Index>(k));
  }
  if (own.empty()) return false;
  const Eigen::VectorXd x = fit.x(own);
  const Eigen::MatrixXd variance = temperature * fit.explained.covariance(own, own);
  return x.dot(variance.ldlt().solve(x)) < k_thresholds.least_size * static_cast<double>(own.size());
}

/// All sets that were looked at. Where more than noise is left that nothing describes, the model is wrong by more, and
/// evidence is worth less.
std::vector<Weighed> Selector::weighed() {
  const double misfit = std::max(1.0, selection_.best.explained.amplitudes.noise / evidence_.floor);
  selection_.temperature = k_thresholds.temperature * misfit;
  std::vector<Weighed> sets;
  for (const auto& [key, fit] : seen_) sets.push_back({fit.effects, score(fit) / selection_.temperature});
  return sets;
}

/// Whether the data say of its numbers that they may as well be nothing, and the readings that it hardly moves them. A
/// friction that holds a joint fast moves it by all there is, and its slope is nothing then.
bool Selector::is_without_size(const Effect& effect) const {
  const Fit& best = selection_.best;
  if (!has_no_size(best, effect, selection_.temperature)) return false;
  const Fit others = workers_.one().fit(without(best.effects, effect), without(best.at, effect));
  return others.usable &&
         rms_apart(evidence_, others.residual, best.residual) < k_thresholds.least_moved * evidence_.floor;
}

/// What is not sure enough to be named, with all that could stand in its place, or has no size to name, goes, the most
/// doubtful first. Whether something went.
bool Selector::drop_doubtful() {
  const std::vector<Weighed> sets = weighed();
  selection_.groups.clear();
  for (const Effect* effect : selection_.best.effects)
    selection_.groups.push_back(credible_group(sets, selection_.best.effects, *effect, k_thresholds.least_of_a_group));
  for (CredibleGroup& group : selection_.groups) {
    if (is_without_size(*group.members.front())) group.doubt = 1;
  }
  const auto worst = std::max_element(selection_.groups.begin(), selection_.groups.end(),
                                      [](const CredibleGroup& a, const CredibleGroup& b) { return a.doubt < b.doubt; });
  if (worst == selection_.groups.end() || worst->doubt <= k_thresholds.most_mistaken) return false;
  const Effect& doubtful = *worst->members.front();
  selection_.best =
      workers_.one().fit(without(selection_.best.effects, doubtful), without(selection_.best.at, doubtful));
  return true;
}

/// What a number is depends on what else is there.
void Selector::look_at_spread() {
  const Fit& best = selection_.best;
  for (std::size_t k = 0; k < best.parameters.size(); ++k) {
    double squares = 0, weights = 0;
    for (const auto& [key, fit] : seen_) {
      const auto own = std::find(fit.parameters.begin(), fit.parameters.end(), best.parameters[k]);
      if (own == fit.parameters.end()) continue;
      const double weight = std::exp((score(fit) - score(best)) / selection_.temperature);
      const double apart = fit.x[own - fit.parameters.begin()] - best.x[static_cast<Eigen::Index>(k)];
      squares += weight * apart * apart;
      weights += weight;
    }
    if (weights > 0) selection_.spread[best.parameters[k]] = squares / weights;
  }
}

std::string nats_words(double nats) {
  const double decades = nats / std::log(10.0);
  return (decades < 0 ? "−" : "") + std::to_string(static_cast<int>(std::lround(std::abs(decades))));
}

/// What the data say of every effect: of those that were accepted what is lost without, of the others what is gained.
void Selector::write_down() {
  const Fit& best = selection_.best;
  for (std::size_t i = 0; i < best.effects.size(); ++i) {
    Candidate candidate;
    candidate.name = best.effects[i]->name;
    candidate.evidence = best.log_evidence - selection_.without[i].log_evidence;
    candidate.accepted = true;
    candidate.why = "without it the data are 10^" + nats_words(candidate.evidence) + " times less likely";
    selection_.tried.push_back(candidate);
  }
  for (const Addition& look : promising(workers_.one(), best, selection_.catalogue.size())) {
    Candidate candidate;
    candidate.name = look.effect->name;
    candidate.evidence = look.promise + rareness_of(*look.effect) - score(best);
    candidate.why = candidate.evidence < 0 ? "the data are likelier without it" : "it adds less than a name needs";
    if (!std::isfinite(candidate.evidence)) candidate.why = "the joint could not be simulated with it";
    selection_.tried.push_back(candidate);
  }
}

Selection Selector::run() {
  selection_.catalogue = catalogue(*evidence_.declared, evidence_.measurement, options_.more_effects, options_.without);
  selection_.none = workers_.one().fit({}, {});
  selection_.best = selection_.none;
  if (!selection_.none.usable || !options_.look_for_effects) return std::move(selection_);
  keep(selection_.none);
  try_singles();
  try_pairs();
  for (int exchanges = 0; exchanges <= k_thresholds.most_exchanges; ++exchanges) {
    while (widen()) {
    }
    settle_best();
    if (!challenge() && !exchange()) break;
  }
  while (drop_doubtful()) {
    while (drop_doubtful()) {
    }
    challenge();
  }
  look_at_spread();
  write_down();
  return std::move(selection_);
}

}  // namespace

double price_of_search(const Effect& effect) {
  const bool searched = std::any_of(effect.parameters.begin(), effect.parameters.end(),
                                    [](const EffectParameter& p) { return p.searched; });
  return searched ? k_thresholds.price_of_a_search : 0.0;
}

double rareness_of(const Effect& effect) { return k_thresholds.rareness + price_of_search(effect); }

double cost_of(const Effect& effect) { return k_thresholds.price_of_a_name + price_of_search(effect); }

double score(const Fit& fit) {
  double score = fit.log_evidence;
  for (const Effect* effect : fit.effects) score -= rareness_of(*effect);
  return score;
}

Selection select_effects(const Evidence& evidence, Workers& workers, const CalibrationOptions& options) {
  return Selector(evidence, workers, options).run();
}

}  // namespace fusee
