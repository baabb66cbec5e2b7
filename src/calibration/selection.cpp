#include "calibration/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "base/decompositions.h"
#include "calibration/catalogue.h"
#include "calibration/thresholds.h"
#include "calibration/unknown.h"
#include "calibration/validation.h"
#include "fusee/calibration/words.h"

// Sets of effects by plain squares first, then a beam over sets by evidence. A set is as good as its evidence, beside a
// discrepancy that may take any smooth shape, and as its effects are common; the best set ever seen is what is looked
// at closely. A wider set is first looked at by the slopes that each effect had alone and by chords beside what is
// there, and fitted only if either promises something. Once nothing is gained, every member is left out and held
// against every effect in its place; and once that gains nothing either, one or two others are tried in the place of
// none, one or two members: a slip and an offset imitated slack and a wave and a lever's length a profile, and no
// single exchange that was looked at led from one to the other. Where something stays unexplained all the same, no look
// is trusted any more: every effect is fitted beside the best, the likeliest single one with each other from nothing,
// and the sets that explain most by plain squares with one member out or in its place changed. Then the likeliest are
// fitted to the end, and all sets ever seen are weighed together, each by its likeliest fit: a member stands if it, or
// what stands in its place elsewhere, is in nearly all of the weight. Where names that leave nothing are as likely as
// what has none, they take its place and say so. What may be there unasked joins its group.

namespace fusee {
namespace {

/// score(), what stays without a name for nothing.
double score_of_names(const Fit& fit) { return fit.log_evidence - rareness_of(fit.effects); }

/// Of amplitudes, in a linear look.
constexpr int k_look_rounds = 4;

/// What an effect adds to a linear look: slopes over the rows in use.
struct Look {
  Eigen::MatrixXd J;
  Eigen::VectorXd prior;
};

/// A set as it explains most where nothing stays without a name.
struct Plain {
  double score = 0;
  Fit fit;
};

/// A fit that is there, and what is tried beside it.
struct Addition {
  const Fit* base = nullptr;
  const Effect* effect = nullptr;
  double promise = -std::numeric_limits<double>::infinity();
  Look look = {};  ///< by which it is promised
};

/// Two effects beside a base.
struct PairBeside {
  const Fit* base = nullptr;
  const Addition* one = nullptr;
  const Addition* other = nullptr;
  double promise = 0;
};

/// Looks beside a base: what is summed over rows is summed once for all sets of them.
class SharedLooks {
 public:
  SharedLooks(const Evidence& evidence, const Fit& base, const Amplitudes& unnamed,
              const std::vector<const Look*>& looks)
      : marginal_(*evidence.marginal) {
    Tangent tangent = tangent_of(evidence, base);
    own_ = tangent.x.size();
    for (const Look* look : looks) {
      first_.push_back(tangent.J.cols());
      add(*look, tangent);
    }
    first_.push_back(tangent.J.cols());
    const TangentSums sums = marginal_.sums_of(tangent);
    beside_ = marginal_.reduced(sums, marginal_.sized(unnamed, sums.give));
  }

  /// With that much unnamed beside them; `chosen`: places in the looks.
  double log_evidence(const std::vector<std::size_t>& chosen) const {
    std::vector<Eigen::Index> columns(static_cast<std::size_t>(own_));
    std::iota(columns.begin(), columns.end(), 0);
    for (const std::size_t i : chosen) {
      for (Eigen::Index k = first_[i]; k < first_[i + 1]; ++k) columns.push_back(k);
    }
    return log_evidence_of(beside_, columns);
  }

  /// One look more, where it does nothing.
  static void add(const Look& look, Tangent& tangent) {
    tangent.J.conservativeResize(Eigen::NoChange, tangent.J.cols() + look.J.cols());
    tangent.J.rightCols(look.J.cols()) = look.J;
    add_numbers(look.prior, tangent);
  }

 private:
  const Marginal& marginal_;
  ReducedTangent beside_;
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
  void take_in(Fit fit);
  void keep(Fit fit);
  Fit likeliest_of_its_set(Fit fit) const;
  bool is_tried(const Key& key) const { return tried_.count(key) > 0; }
  std::vector<const Fit*> ranked() const;
  double promised(const Fit& base, const EffectSet& added, const std::vector<const Look*>& looks,
                  const Amplitudes& unnamed) const;
  std::vector<Look> looks_beside(const Fitter& fitter, const Fit& base, const Effect& effect) const;
  using FitOne = Fit (Selector::*)(const Fitter&, const Addition&) const;
  std::vector<Fit> fitted(const std::string& what, const std::vector<Addition>& added, FitOne fit_one);
  Fit fitted_a_little(const Fitter& fitter, const Addition& added) const;
  Fit fitted_to_the_end(const Fitter& fitter, const Addition& added) const;
  Fit fitted_plainly(const Fitter& fitter, const Addition& added) const;
  std::vector<Addition> each_alone() const;
  void try_singles();
  Explained plainly(const Fit& fit) const;
  double plain_score(const Fit& fit) const;
  std::vector<Fit> singles_plainly();
  std::vector<Fit> wider_plainly(const std::vector<const Fit*>& beam);
  std::vector<const Plain*> remembered_plainly() const;
  std::vector<const Plain*> remember_plainly(std::vector<Fit> fits);
  std::vector<const Plain*> take_in_plainly(std::vector<Fit> fits);
  void explain_plainly();
  std::vector<Fit> reduced_plainly(const std::vector<const Plain*>& sets, std::set<Key>& reduced);
  bool try_pairs_from_nothing();
  bool exchange_plainly();
  void take_widest();
  bool widen();
  void take_best(Fit best);
  std::vector<Fit> settled(const std::vector<const Fit*>& fits);
  void settle_best();
  bool settle_rivals();
  std::vector<Addition> promising(const Fitter& fitter, const Fit& base, const Amplitudes& unnamed,
                                  std::size_t most) const;
  const std::vector<Addition>& beside_best();
  bool challenge();
  std::vector<Fit> reduced() const;
  std::vector<PairBeside> pairs_beside(const Fit& base, const Amplitudes& unnamed,
                                       const std::vector<Addition>& looks) const;
  std::vector<PairBeside> pairs_beside(const Fit& base, const std::vector<Addition>& looks) const;
  bool exchange();
  bool try_all_beside();
  std::vector<Weighed> weighed();
  std::optional<std::size_t> shares_with(const Fit& wider) const;
  void join_companions();
  std::optional<double> square_about_best(const Fit& fit, Eigen::Index place) const;
  void look_at_variance();
  bool is_for_nothing(const Effect& effect, const Fit& others) const;
  CredibleGroup group_of(const std::vector<Weighed>& sets, const Effect& effect) const;
  bool is_some_name(const std::vector<Weighed>& sets, const Effect& effect) const;
  void leave_each_out();
  bool leaves_unexplained(const Fit& fit) const;
  bool is_completed_beside(const Fit& others) const;
  bool drop_doubtful();
  void drop_all_doubtful();
  std::vector<std::pair<double, const Fit*>> ranked_plainly();
  const Fit* completed_by_names();
  void complete_by_names();
  void drop_what_predicts_nothing();
  void write_down();

  void report(const std::string& what, double share) const { options_.context.begin_step(what, share); }
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
  std::map<Key, Plain> plainly_;                      ///< sets that were looked at so
  std::optional<std::vector<Addition>> beside_best_;  ///< until there is another best
  std::vector<Fit> companions_;                       ///< the best with one effect more that may be there
  std::set<Key> tried_;                               ///< sets that were reached beside what has no name
};

Selector::Key Selector::key_of(const EffectSet& effects) const {
  Key key;
  for (const Effect* effect : effects) key.push_back(place_of(*effect));
  std::sort(key.begin(), key.end());
  return key;
}

/// Its set is not tried again.
void Selector::keep(Fit fit) {
  if (fit.usable) tried_.insert(key_of(fit.effects));
  take_in(std::move(fit));
}

void Selector::take_in(Fit fit) {
  if (!fit.usable) return;
  const auto [place, added] = seen_.try_emplace(key_of(fit.effects), fit);
  if (!added && fit.log_evidence > place->second.log_evidence) place->second = std::move(fit);
}

/// Itself, or one that was seen: where a joint sticks and slips a fit from elsewhere may end on a lower summit, and
/// what was left out would seem to matter more, or the others less, than they do (reserved split, seed 192006: by 36
/// nats).
Fit Selector::likeliest_of_its_set(Fit fit) const {
  const auto seen = seen_.find(key_of(fit.effects));
  const bool is_seen = seen != seen_.end() && !(fit.usable && score(fit) >= score(seen->second));
  return is_seen ? seen->second : fit;
}

std::vector<const Fit*> Selector::ranked() const {
  std::vector<const Fit*> all;
  for (const auto& [key, fit] : seen_) all.push_back(&fit);
  std::stable_sort(all.begin(), all.end(), [](const Fit* a, const Fit* b) { return score(*a) > score(*b); });
  return all;
}

std::vector<Fit> Selector::fitted(const std::string& what, const std::vector<Addition>& added, FitOne fit_one) {
  std::vector<Fit> fits(added.size());
  const double count = static_cast<double>(std::max<std::size_t>(1, added.size()));
  report(what, 0);
  workers_.each(
      added.size(), [&](const Fitter& fitter, std::size_t i) { fits[i] = (this->*fit_one)(fitter, added[i]); },
      [&](std::size_t done) { report(what, static_cast<double>(done) / count); });
  return fits;
}

/// Whether a look promised more than a short fit reached: the slopes that the base had are no longer its own, and the
/// end is elsewhere (unread split, seed 211303: an offset beside an encoder's eccentricity, 200 nats).
bool ended_early(const Fit& fit, const Addition& added) { return score(fit) < added.promise - k_thresholds.as_good; }

/// Closely enough to compare by.
Fit Selector::fitted_a_little(const Fitter& fitter, const Addition& added) const {
  Fit fit = fitter.with_effect(*added.base, *added.effect);
  return fit.usable && ended_early(fit, added) ? fitter.fit(fit.effects, fit.at) : fit;
}

/// To the end unless it is far behind the best.
Fit Selector::fitted_to_the_end(const Fitter& fitter, const Addition& added) const {
  Fit fit = fitter.with_effect(*added.base, *added.effect);
  const bool is_near = fit.usable && score(fit) > score(selection_.best) - k_thresholds.far;
  return is_near || (fit.usable && ended_early(fit, added)) ? fitter.fit(fit.effects, fit.at) : fit;
}

/// Of the catalogue, beside nothing.
std::vector<Addition> Selector::each_alone() const {
  std::vector<Addition> all;
  for (const Effect* effect : selection_.catalogue) all.push_back({&selection_.none, effect});
  return all;
}

void Selector::try_singles() {
  std::vector<Fit> fits = fitted("trying effects one by one", each_alone(), &Selector::fitted_to_the_end);
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
                          const Amplitudes& unnamed) const {
  Tangent tangent = tangent_of(evidence_, base);
  const double cost = rareness_of(base.effects) + rareness_of(added);
  for (const Look* of_one : looks) {
    if (of_one->J.size() == 0) return -std::numeric_limits<double>::infinity();
    SharedLooks::add(*of_one, tangent);
  }
  const double loose = base.explained.log_evidence - base.log_evidence;
  const Marginal& marginal = *evidence_.marginal;
  const Explained explained = marginal.best(tangent, unnamed, k_look_rounds);
  const double promise = explained.log_evidence - marginal.rareness_of_rest(explained) - loose - cost;
  return std::isfinite(promise) ? promise : -std::numeric_limits<double>::infinity();
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
std::vector<Addition> Selector::promising(const Fitter& fitter, const Fit& base, const Amplitudes& unnamed,
                                          std::size_t most) const {
  EffectSet effects = selection_.catalogue;
  std::erase_if(effects, [&](const Effect* effect) { return contains(base.effects, *effect); });
  std::vector<std::vector<Look>> looks(effects.size());
  std::vector<const Look*> flat;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    looks[i] = looks_beside(fitter, base, *effects[i]);
    for (const Look& look : looks[i]) flat.push_back(&look);
  }
  const SharedLooks shared(evidence_, base, unnamed, flat);
  std::vector<Addition> all;
  std::size_t place = 0;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Look& alone = looks_[place_of(*effects[i])];
    Addition best{&base, effects[i], promised(base, {effects[i]}, {&alone}, unnamed), alone};
    double most_likely = -std::numeric_limits<double>::infinity();
    const Look* likeliest = nullptr;
    for (const Look& look : looks[i]) {
      const double likely = shared.log_evidence({place++});
      if (likely > most_likely) most_likely = likely, likeliest = &look;
    }
    const double promise = likeliest == nullptr ? most_likely : promised(base, {effects[i]}, {likeliest}, unnamed);
    if (promise > best.promise) best.promise = promise, best.look = *likeliest;
    all.push_back(std::move(best));
  }
  std::stable_sort(all.begin(), all.end(), [](const Addition& a, const Addition& b) { return a.promise > b.promise; });
  all.resize(std::min(all.size(), most));
  return all;
}

/// Of the whole catalogue.
const std::vector<Addition>& Selector::beside_best() {
  const Fit& best = selection_.best;
  if (!beside_best_)
    beside_best_ = promising(workers_.one(), best, best.explained.amplitudes, selection_.catalogue.size());
  return *beside_best_;
}

void Selector::take_best(Fit best) {
  selection_.best = std::move(best);
  selection_.without.clear();
  beside_best_.reset();
}

/// Where nothing stays without a name but noise, as much as it takes.
Explained Selector::plainly(const Fit& fit) const {
  return evidence_.marginal->best(tangent_of(evidence_, fit), evidence_.marginal->nothing_unnamed());
}

double Selector::plain_score(const Fit& fit) const {
  return score_of_names(fit) - fit.explained.log_evidence + plainly(fit).log_evidence;
}

/// Each of the beam with one effect more, the best first.
std::vector<Fit> Selector::wider_plainly(const std::vector<const Fit*>& beam) {
  std::vector<std::vector<Addition>> looks(beam.size());
  workers_.each(beam.size(), [&](const Fitter& fitter, std::size_t i) {
    looks[i] = promising(fitter, *beam[i], plainly(*beam[i]).amplitudes, k_thresholds.plain_looks);
  });
  std::map<Key, Addition> added;
  for (const std::vector<Addition>& look : looks) {
    for (const Addition& addition : look) {
      EffectSet effects = addition.base->effects;
      effects.push_back(addition.effect);
      added.try_emplace(key_of(effects), addition);
    }
  }
  std::vector<Addition> each;
  for (const auto& [key, addition] : added) each.push_back(addition);
  std::vector<Fit> wider(each.size());
  workers_.each(each.size(), [&](const Fitter& fitter, std::size_t i) {
    wider[i] = fitter.with_effect_alone(*each[i].base, *each[i].effect);
  });
  std::erase_if(wider, [](const Fit& fit) { return !fit.usable; });
  return wider;
}

/// Where it explains most if nothing stays without a name: beside what has none, friction that holds a joint fast ends
/// as none at all (unopened split, seed 201021).
Fit Selector::fitted_plainly(const Fitter& fitter, const Addition& added) const {
  Fit fit = fitter.with_effect_alone(*added.base, *added.effect);
  const auto seen = seen_.find(key_of({added.effect}));
  const bool is_better = seen == seen_.end() || (fit.usable && plain_score(fit) > plain_score(seen->second));
  return is_better ? fit : seen->second;
}

/// No effect and each by itself.
std::vector<Fit> Selector::singles_plainly() {
  std::vector<Fit> singles = fitted("trying effects one by one", each_alone(), &Selector::fitted_plainly);
  std::erase_if(singles, [](const Fit& fit) { return !fit.usable; });
  singles.insert(singles.begin(), selection_.none);
  return singles;
}

/// The first few of them by their scores.
std::vector<const Plain*> likeliest_plainly(std::vector<const Plain*> all) {
  std::stable_sort(all.begin(), all.end(), [](const Plain* a, const Plain* b) { return a->score > b->score; });
  all.resize(std::min(all.size(), k_thresholds.plain_beam));
  return all;
}

std::vector<const Fit*> fits_of(const std::vector<const Plain*>& sets) {
  std::vector<const Fit*> fits;
  for (const Plain* plain : sets) fits.push_back(&plain->fit);
  return fits;
}

/// Of all sets that were looked at plainly.
std::vector<const Plain*> Selector::remembered_plainly() const {
  std::vector<const Plain*> all;
  for (const auto& [key, plain] : plainly_) all.push_back(&plain);
  return likeliest_plainly(std::move(all));
}

/// Of these sets, each where it is likeliest.
std::vector<const Plain*> Selector::remember_plainly(std::vector<Fit> fits) {
  std::vector<double> scores(fits.size());
  workers_.each(fits.size(), [&](const Fitter&, std::size_t i) { scores[i] = plain_score(fits[i]); });
  std::vector<const Plain*> all;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const auto [place, added] = plainly_.try_emplace(key_of(fits[i].effects));
    if (added || scores[i] > place->second.score) place->second = {scores[i], std::move(fits[i])};
    all.push_back(&place->second);
  }
  return likeliest_plainly(std::move(all));
}

/// The same of sets that count beside what has no name too.
std::vector<const Plain*> Selector::take_in_plainly(std::vector<Fit> fits) {
  for (const Fit& fit : fits) take_in(fit);
  return remember_plainly(std::move(fits));
}

/// Sets that explain most where nothing stays without a name, until little does. Beside what has none, sets of two do
/// no better than it where three are needed; of plain squares each takes its part. Such a fit may end on another summit
/// than one beside what has no name, and its set stays to be tried.
void Selector::explain_plainly() {
  std::vector<const Plain*> beam = remember_plainly(singles_plainly());
  while (beam.front()->score < score_of_names(beam.front()->fit) - k_thresholds.little_unnamed &&
         beam.front()->fit.effects.size() < k_thresholds.most_effects) {
    std::vector<Fit> wider = wider_plainly(fits_of(beam));
    if (wider.empty()) break;
    const double before = beam.front()->score;
    beam = take_in_plainly(std::move(wider));
    if (beam.front()->score <= before) break;
  }
  for (Fit& fit : settled(fits_of(beam))) take_in(std::move(fit));
}

/// Each of these without each of its members, to the end: those that were not looked at so before.
std::vector<Fit> Selector::reduced_plainly(const std::vector<const Plain*>& sets, std::set<Key>& reduced) {
  std::vector<std::pair<const Fit*, const Effect*>> each;
  for (const Plain* plain : sets) {
    for (const Effect* effect : plain->fit.effects) {
      if (reduced.insert(key_of(without(plain->fit.effects, *effect))).second) each.emplace_back(&plain->fit, effect);
    }
  }
  std::vector<Fit> fits(each.size());
  workers_.each(each.size(), [&](const Fitter& fitter, std::size_t i) {
    const auto& [fit, effect] = each[i];
    fits[i] = fitter.fit(without(fit->effects, *effect), without(fit->at, *effect));
  });
  std::erase_if(fits, [](const Fit& fit) { return !fit.usable; });
  return fits;
}

/// Where something stays unexplained: the likeliest single effect with each other, both from nothing. Where it is by
/// itself may be far from where it is beside the other, and looks and steps from there lead elsewhere: of a joint that
/// goes loose, warmth with the wrong sign (unmet split, seeds 231286 and 231291: 70 and 12 nats). Whether a better set
/// was found.
bool Selector::try_pairs_from_nothing() {
  if (!leaves_unexplained(selection_.best)) return false;
  const double before = score(selection_.best);
  const std::vector<const Fit*> all = ranked();
  const auto single = std::find_if(all.begin(), all.end(), [](const Fit* fit) { return fit->effects.size() == 1; });
  std::vector<EffectSet> pairs;
  for (const Effect* effect : selection_.catalogue) {
    if (single != all.end() && !contains((*single)->effects, *effect))
      pairs.push_back({(*single)->effects.front(), effect});
  }
  std::vector<Fit> fits(pairs.size());
  workers_.each(pairs.size(), [&](const Fitter& fitter, std::size_t i) { fits[i] = fitter.fit(pairs[i], {}); });
  std::erase_if(fits, [](const Fit& fit) { return !fit.usable; });
  take_in_plainly(std::move(fits));
  return score(*ranked().front()) > before + k_thresholds.better;
}

/// Where something stays unexplained: of the sets that explain most as if nothing did, one member is left out, or
/// another is tried in its place, until that gains nothing: wider sets went astray where pins took what a scale
/// does beside two others (unmet split, seed 231226: 3 nats). Whether a better set was found.
bool Selector::exchange_plainly() {
  const double before = score(selection_.best);
  const double names = remembered_plainly().front()->score;
  if (!leaves_unexplained(selection_.best) || names < before - k_thresholds.far) return false;
  std::set<Key> reduced;
  for (int exchanges = 0; exchanges <= k_thresholds.most_exchanges; ++exchanges) {
    const double reached = remembered_plainly().front()->score;
    std::vector<Fit> instead = reduced_plainly(remembered_plainly(), reduced);
    std::vector<const Fit*> less;
    for (const Fit& fit : instead) less.push_back(&fit);
    std::vector<Fit> wider = wider_plainly(less);
    instead.insert(instead.end(), wider.begin(), wider.end());
    take_in_plainly(std::move(instead));
    if (!(remembered_plainly().front()->score > reached + k_thresholds.better)) break;
  }
  for (Fit& fit : settled(fits_of(remembered_plainly()))) keep(std::move(fit));
  return score(*ranked().front()) > before + k_thresholds.better;
}

/// Whether a wider set than those of the beam does better than the best so far.
bool Selector::widen() {
  std::vector<const Fit*> beam = ranked();
  beam.resize(std::min(beam.size(), k_thresholds.beam));
  const double before = score(*beam.front());
  std::vector<std::vector<Addition>> looks(beam.size());
  workers_.each(beam.size(), [&](const Fitter& fitter, std::size_t i) {
    if (beam[i]->effects.size() < k_thresholds.most_effects)
      looks[i] = promising(fitter, *beam[i], beam[i]->explained.amplitudes, k_thresholds.most_looks);
  });
  std::vector<Addition> added;
  for (const std::vector<Addition>& look : looks) {
    for (const Addition& addition : look) {
      EffectSet effects = addition.base->effects;
      effects.push_back(addition.effect);
      if (addition.promise > before - k_thresholds.hopeless && !is_tried(key_of(effects))) added.push_back(addition);
    }
  }
  std::vector<Fit> fits = fitted("trying wider sets of effects", added, &Selector::fitted_a_little);
  for (Fit& fit : fits) keep(std::move(fit));
  return score(*ranked().front()) > before;
}

std::vector<Fit> Selector::settled(const std::vector<const Fit*>& fits) {
  std::vector<Fit> to_the_end(fits.size());
  workers_.each(fits.size(), [&](const Fitter& fitter, std::size_t i) {
    to_the_end[i] = fitter.fit(fits[i]->effects, fits[i]->at);
  });
  return to_the_end;
}

/// The best few are fitted to the end.
void Selector::settle_best() {
  std::vector<const Fit*> all = ranked();
  all.resize(std::min(all.size(), k_thresholds.beam));
  for (Fit& fit : settled(all)) keep(std::move(fit));
  const Fit* likeliest = ranked().front();
  Fit best = workers_.one().fit(likeliest->effects, likeliest->at);
  take_best(best.usable && best.log_evidence >= likeliest->log_evidence ? std::move(best) : *likeliest);
}

/// The best, made wider as long as that gains.
void Selector::take_widest() {
  while (widen()) {
  }
  settle_best();
}

/// What may stand in the place of some of the best is weighed by fits to the end: a fit that ended early was 13 nats
/// below its summit, and its pins stood in no group (reserved split, seed 192070). Whether a better set was found.
bool Selector::settle_rivals() {
  const double before = score(selection_.best);
  std::vector<const Fit*> rivals = ranked();
  std::erase_if(rivals, [&](const Fit* fit) {
    return fit->effects.size() > selection_.best.effects.size() || score(*fit) < before - k_thresholds.hopeless;
  });
  rivals.resize(std::min(rivals.size(), k_thresholds.most_settled));
  for (Fit& fit : settled(rivals)) keep(std::move(fit));
  return score(*ranked().front()) > before + k_thresholds.better;
}

/// The best without each of its members, the others fitted anew, once.
void Selector::leave_each_out() {
  const Fit& best = selection_.best;
  if (selection_.without.size() == best.effects.size()) return;
  selection_.without.assign(best.effects.size(), {});
  workers_.each(best.effects.size(), [&](const Fitter& fitter, std::size_t i) {
    const Effect& effect = *best.effects[i];
    selection_.without[i] = likeliest_of_its_set(fitter.fit(without(best.effects, effect), without(best.at, effect)));
  });
}

/// Every member is left out, and held against every effect in its place that a look does not give up, and against those
/// whose place is searched for, or that hold the joint fast: of a profile's wave in the place of a runout a look
/// promised nothing, and it was 13 nats likelier (matrix, seed 41022), of a joint's friction in the place of play 35
/// (unopened split, seed 202192). A look that would give up the member itself gives up nothing that promises as much
/// (202208: a runout in the place of pins, 4 nats likelier). Whether a better set was found.
bool Selector::challenge() {
  const Fit& best = selection_.best;
  leave_each_out();
  std::vector<std::vector<Addition>> looks(best.effects.size());
  workers_.each(best.effects.size(), [&](const Fitter& fitter, std::size_t i) {
    const Fit& less = selection_.without[i];
    if (less.usable) looks[i] = promising(fitter, less, less.explained.amplitudes, selection_.catalogue.size());
  });
  selection_.rivals.clear();
  std::vector<Addition> added;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const auto own = std::find_if(looks[i].begin(), looks[i].end(),
                                  [&](const Addition& addition) { return addition.effect == best.effects[i]; });
    for (const Addition& addition : looks[i]) {
      const bool says_little = is_searched(*addition.effect) || addition.effect->sticks;
      const bool is_worse = addition.promise < std::min(own->promise, score(best) - k_thresholds.far);
      const bool given_up = is_worse && !says_little;
      if (given_up || contains(best.effects, *addition.effect)) continue;
      selection_.rivals.push_back({best.effects[i], addition.effect, {}});
      added.push_back(addition);
    }
  }
  std::vector<Fit> fits = fitted("holding rivals against what was found", added, &Selector::fitted_to_the_end);
  for (std::size_t i = 0; i < fits.size(); ++i) selection_.rivals[i].fit = std::move(fits[i]);
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
    all[k] = likeliest_of_its_set(
        fitter.fit(without(without(best.effects, one), other), without(without(best.at, one), other)));
  });
  all.insert(all.end(), selection_.without.begin(), selection_.without.end());
  all.push_back(best);
  std::erase_if(all, [](const Fit& fit) { return !fit.usable; });
  std::stable_sort(all.begin(), all.end(), [](const Fit& a, const Fit& b) { return score(a) > score(b); });
  all.resize(std::min(all.size(), k_thresholds.most_reduced));
  return all;
}

/// The best pairs, none of whose effects is in more than a few: the chord of a slack takes what it meets, promises much
/// beside any other, and kept nothing of it (unopened split, seeds 201046, 201142, 201159).
std::vector<PairBeside> best_of_each(std::vector<PairBeside> pairs, std::size_t most) {
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const PairBeside& a, const PairBeside& b) { return a.promise > b.promise; });
  std::vector<PairBeside> best;
  std::map<const Effect*, std::size_t> times;
  for (const PairBeside& pair : pairs) {
    if (best.size() == most) break;
    std::size_t &one = times[pair.one->effect], &other = times[pair.other->effect];
    if (std::max(one, other) >= k_thresholds.most_of_each) continue;
    ++one, ++other;
    best.push_back(pair);
  }
  return best;
}

/// The best of all pairs of `looks` by a linear look, sets that were not looked at, with so much unnamed beside them.
std::vector<PairBeside> Selector::pairs_beside(const Fit& base, const Amplitudes& unnamed,
                                               const std::vector<Addition>& looks) const {
  std::vector<const Look*> usable;
  std::vector<const Addition*> owners;
  for (const Addition& addition : looks) {
    if (addition.look.J.size() == 0) continue;
    usable.push_back(&addition.look);
    owners.push_back(&addition);
  }
  const SharedLooks shared(evidence_, base, unnamed, usable);
  std::vector<PairBeside> pairs;
  for (std::size_t i = 0; i < owners.size(); ++i) {
    for (std::size_t j = i + 1; j < owners.size(); ++j) {
      EffectSet effects = base.effects;
      effects.insert(effects.end(), {owners[i]->effect, owners[j]->effect});
      if (is_tried(key_of(effects))) continue;
      const double cost = rareness_of(*owners[i]->effect) + rareness_of(*owners[j]->effect);
      pairs.push_back({&base, owners[i], owners[j], shared.log_evidence({i, j}) - cost});
    }
  }
  pairs = best_of_each(std::move(pairs), k_thresholds.most_looks_instead);
  for (PairBeside& pair : pairs)
    pair.promise =
        promised(base, {pair.one->effect, pair.other->effect}, {&pair.one->look, &pair.other->look}, unnamed);
  return pairs;
}

/// The same where what has no name stays as large as it is beside the base, and where there is none: two that explain
/// all between them are of little use as long as it explains as much (unopened split, seed 201142: 7 nats).
std::vector<PairBeside> Selector::pairs_beside(const Fit& base, const std::vector<Addition>& looks) const {
  std::vector<PairBeside> pairs = pairs_beside(base, base.explained.amplitudes, looks);
  for (const PairBeside& pair : pairs_beside(base, plainly(base).amplitudes, looks)) {
    const auto known = std::find_if(pairs.begin(), pairs.end(), [&](const PairBeside& other) {
      return other.one == pair.one && other.other == pair.other;
    });
    if (known == pairs.end()) {
      pairs.push_back(pair);
    } else {
      known->promise = std::max(known->promise, pair.promise);
    }
  }
  return best_of_each(std::move(pairs), k_thresholds.most_instead);
}

/// One or two others in the place of none, one or two members: what takes two exchanges at once, since either alone is
/// worse. Whether a better set was found.
bool Selector::exchange() {
  const double before = score(selection_.best);
  const std::vector<Fit> bases = reduced();
  std::vector<std::vector<Addition>> looks(bases.size());
  workers_.each(bases.size(), [&](const Fitter& fitter, std::size_t i) {
    if (bases[i].effects.size() < k_thresholds.most_effects)
      looks[i] = promising(fitter, bases[i], bases[i].explained.amplitudes, selection_.catalogue.size());
  });
  std::vector<std::vector<PairBeside>> pairs(bases.size());
  workers_.each(bases.size(), [&](const Fitter&, std::size_t i) {
    if (bases[i].effects.size() + 2 <= k_thresholds.most_effects) pairs[i] = pairs_beside(bases[i], looks[i]);
  });
  std::vector<Addition> singles;
  std::vector<PairBeside> both;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    for (std::size_t k = 0; k < std::min(looks[i].size(), k_thresholds.most_instead); ++k) {
      EffectSet effects = bases[i].effects;
      effects.push_back(looks[i][k].effect);
      if (looks[i][k].promise > before - k_thresholds.hopeless && !is_tried(key_of(effects)))
        singles.push_back(looks[i][k]);
    }
    for (const PairBeside& pair : pairs[i]) {
      if (pair.promise > before - k_thresholds.hopeless) both.push_back(pair);
    }
  }
  std::vector<Fit> fits = fitted("exchanging effects", singles, &Selector::fitted_a_little);
  std::vector<Fit> wider(both.size());
  workers_.each(both.size(), [&](const Fitter& fitter, std::size_t k) {
    const Fit one = fitter.with_effect(*both[k].base, *both[k].one->effect);
    if (one.usable) wider[k] = fitted_to_the_end(fitter, {&one, both[k].other->effect});
  });
  for (Fit& fit : fits) keep(std::move(fit));
  for (Fit& fit : wider) keep(std::move(fit));
  return score(*ranked().front()) > before + k_thresholds.better;
}

/// Where something stays unexplained every effect is fitted beside the best, whatever a look says of it: of a joint
/// that its friction holds fast for most of a stroke, slopes and chords say nothing of a stretch that makes the data 78
/// nats likelier (reserved split, seed 191112). Whether a better set was found.
bool Selector::try_all_beside() {
  const Fit& best = selection_.best;
  if (best.effects.size() >= k_thresholds.most_effects || !leaves_unexplained(best)) return false;
  const double before = score(best);
  const std::vector<Addition>& added = beside_best();
  std::vector<Fit> fits = fitted("trying every effect beside what was found", added, &Selector::fitted_to_the_end);
  for (Fit& fit : fits) {
    if (score(fit) >= before - k_thresholds.far) keep(std::move(fit));
  }
  return score(*ranked().front()) > before + k_thresholds.better;
}

/// True if one of its numbers stands at the end of its range: the data ask for more of it than any joint has, and so
/// for something else. Where it is searched for the end may be where it is, and what is nothing has no end.
bool is_at_bound(const Fit& fit, const Effect& effect) {
  return std::any_of(effect.parameters.begin(), effect.parameters.end(), [&](const EffectParameter& parameter) {
    return !parameter.searched && value_of(fit.at, parameter) != 0 && !is_idle(parameter, fit.at) &&
           at_bound(fit.at, parameter);
  });
}

/// True if the fits differ by as much as can be seen beside the noise that is left, and rows that were not fitted, whole
/// runs and whole levels of load and speed, are predicted worse without the effect, the others fitted anew.
bool predicts(const Evidence& evidence, const Fit& with, const Fit& without) {
  const double noise = std::max(evidence.floor, with.explained.amplitudes.noise);
  return rms_apart(evidence, with.residual, without.residual) > k_thresholds.least_left * noise &&
         without.by_run.mean_square + without.by_factor.mean_square >
             with.by_run.mean_square + with.by_factor.mean_square;
}

/// All sets that were looked at: of the declared joint's with one effect all were fitted, of the best's those that
/// promised something, and the others count by what they promise. Where more than noise is left that nothing describes,
/// the model is wrong by more, and evidence is worth less.
std::vector<Weighed> Selector::weighed() {
  const Fit& best = selection_.best;
  const double misfit = std::max(1.0, best.explained.amplitudes.noise / evidence_.floor);
  selection_.temperature = k_thresholds.temperature * misfit;
  std::vector<Weighed> sets;
  for (const auto& [key, fit] : seen_) sets.push_back({fit.effects, score(fit) / selection_.temperature});
  if (best.effects.empty()) return sets;
  for (const Addition& look : beside_best()) {
    EffectSet effects = best.effects;
    effects.push_back(look.effect);
    if (!seen_.count(key_of(effects)) && look.promise < score(best))
      sets.push_back({std::move(effects), look.promise / selection_.temperature});
  }
  return sets;
}

/// Whether the joint is likelier without it: two groups of which each holds what stands in the other's place may be
/// sure of both. Or whether it predicts nothing, or only by more than any joint has of it.
bool Selector::is_for_nothing(const Effect& effect, const Fit& others) const {
  const Fit& best = selection_.best;
  if (!others.usable) return false;
  return score(others) > score(best) || !predicts(evidence_, best, others) || is_at_bound(best, effect);
}

/// Where nothing in its place may be there as well, each of all others takes a little of the doubt away, and says
/// nothing.
CredibleGroup Selector::group_of(const std::vector<Weighed>& sets, const Effect& effect) const {
  return credible_group(sets, selection_.best.effects, effect, k_thresholds.least_of_a_group, k_thresholds.least_gain);
}

/// Whether it, or any effect of the catalogue in its place, is as sure as a name is: which it is may be less so.
bool Selector::is_some_name(const std::vector<Weighed>& sets, const Effect& effect) const {
  return credible_group(sets, selection_.best.effects, effect, k_thresholds.most_mistaken).doubt <=
         k_thresholds.most_mistaken;
}

bool Selector::leaves_unexplained(const Fit& fit) const {
  return is_unexplained(unnamed_beside(evidence_, fit), evidence_.floor);
}

/// Whether all is explained by the best, or clearly more, or all of a part, and not by these of its members.
bool Selector::is_completed_beside(const Fit& others) const {
  const Fit& best = selection_.best;
  const Unnamed beside_others = unnamed_beside(evidence_, others);
  if (!is_unexplained(beside_others, evidence_.floor)) return false;
  const Unnamed beside_best = unnamed_beside(evidence_, best);
  return beside_best.rms < k_thresholds.part_left * beside_others.rms ||
         !is_unexplained(beside_best, evidence_.floor) ||
         is_without_a_part(beside_best, beside_others, evidence_.floor);
}

/// An effect that is not sure enough to be named, with all that could stand in its place, or predicts nothing, goes, the most
/// doubtful first. What completes an explanation may stay with more doubt: its group will say that it may be nothing
/// with a name. Whether something went.
bool Selector::drop_doubtful() {
  const std::vector<Weighed> sets = weighed();
  leave_each_out();
  selection_.groups.clear();
  std::vector<std::size_t> doubtful;
  for (const Effect* effect : selection_.best.effects) {
    const std::size_t place = selection_.groups.size();
    CredibleGroup& group = selection_.groups.emplace_back(group_of(sets, *effect));
    if (is_for_nothing(*effect, selection_.without[place])) group.doubt = 1;
    if (group.doubt > k_thresholds.most_mistaken) doubtful.push_back(place);
  }
  std::stable_sort(doubtful.begin(), doubtful.end(), [&](std::size_t a, std::size_t b) {
    return selection_.groups[a].doubt > selection_.groups[b].doubt;
  });
  for (const std::size_t place : doubtful) {
    const Effect& effect = *selection_.best.effects[place];
    const Fit& others = selection_.without[place];
    const double doubt = others.usable ? selection_.groups[place].doubt : 1.0;
    if (doubt < k_thresholds.most_doubtful && is_some_name(sets, effect)) continue;
    if (doubt < k_thresholds.most_doubtful_part && is_completed_beside(others)) continue;
    take_best(others);
    return true;
  }
  return false;
}

/// What is left is held against rivals again. One that is likelier than all there was before takes its place: a set of
/// which a member had no size was 16 nats below one that needs it (reserved split, seed 191030).
void Selector::drop_all_doubtful() {
  double reached = score(selection_.best);
  while (drop_doubtful()) {
    while (drop_doubtful()) {
    }
    while (challenge() && score(*ranked().front()) > reached + k_thresholds.better) {
      settle_best();
      reached = score(selection_.best);
    }
  }
}

/// To a group, but for what `best` has elsewhere.
void add_members(const EffectSet& members, const EffectSet& best, CredibleGroup& group) {
  for (const Effect* member : members) {
    if (!contains(group.members, *member) && !contains(best, *member)) group.members.push_back(member);
  }
}

/// Scores of all sets that were looked at, as if nothing stayed without a name, the best first.
std::vector<std::pair<double, const Fit*>> Selector::ranked_plainly() {
  std::vector<std::pair<double, const Fit*>> all;
  for (const Fit* fit : ranked()) all.emplace_back(0.0, fit);
  workers_.each(all.size(), [&](const Fitter&, std::size_t i) { all[i].first = plain_score(*all[i].second); });
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  return all;
}

/// Of the sets that keep what is named the likeliest as if nothing stayed without a name, where the data do not ask for
/// something that does.
const Fit* Selector::completed_by_names() {
  const auto keeping_names = [&] {
    std::vector<std::pair<double, const Fit*>> all = ranked_plainly();
    std::erase_if(all, [&](const auto& set) {
      return !std::all_of(selection_.groups.begin(), selection_.groups.end(),
                          [&](const CredibleGroup& group) { return shares(set.second->effects, group.members); });
    });
    return all;
  };
  std::vector<const Fit*> likeliest;
  for (const auto& [likely, fit] : keeping_names()) {
    if (likeliest.size() < k_thresholds.plain_beam) likeliest.push_back(fit);
  }
  for (Fit& fit : settled(likeliest)) take_in(std::move(fit));
  const std::vector<std::pair<double, const Fit*>> names = keeping_names();
  const double asked = score(*ranked().front()) - k_thresholds.unexplained;
  return names.empty() || names.front().first < asked ? nullptr : names.front().second;
}

/// Where names alone are so likely that nobody would say of what they leave that it has no name, they take the place of
/// what has none: the data do not tell which it is, and each group says so. Which names is asked as if nothing stayed
/// without one.
void Selector::complete_by_names() {
  const Unnamed instead = unnamed_beside(evidence_, selection_.best);
  if (!is_unexplained(instead, evidence_.floor) || instead.rms < k_thresholds.least_completed * evidence_.floor) return;
  const Fit* names = completed_by_names();
  if (names == nullptr) return;
  selection_.instead = instead.parts;
  const std::vector<CredibleGroup> sure = std::move(selection_.groups);
  take_best(*names);
  challenge();
  std::vector<Weighed> plainly;
  for (const auto& [likely, fit] : ranked_plainly()) plainly.push_back({fit->effects, likely / selection_.temperature});
  selection_.groups.clear();
  for (const Effect* effect : selection_.best.effects) {
    CredibleGroup& group = selection_.groups.emplace_back(group_of(plainly, *effect));
    group.doubt = 1;
    for (const CredibleGroup& known : sure) {
      if (!contains(known.members, *effect)) continue;
      group.doubt = known.doubt;
      add_members(known.members, selection_.best.effects, group);
    }
  }
}

/// Drops names that took the place of an unmodelled cause.
void Selector::drop_what_predicts_nothing() {
  for (std::size_t i = 0; i < selection_.best.effects.size();) {
    leave_each_out();
    const Fit& others = selection_.without[i];
    if (!others.usable ||
        (predicts(evidence_, selection_.best, others) && !is_at_bound(selection_.best, *selection_.best.effects[i]))) {
      ++i;
      continue;
    }
    drop_effect(workers_, i, "", selection_);
    beside_best_.reset();
    i = 0;
  }
}

/// Root mean square over the rows of what a Gaussian of covariance `C` does by the slopes `J`, rad.
double rms_by(const Eigen::MatrixXd& J, const Eigen::MatrixXd& C) {
  return std::sqrt(std::max(0.0, (J * C).cwiseProduct(J).sum()) /
                   static_cast<double>(std::max<Eigen::Index>(1, J.rows())));
}

/// The place of the member that shares what `wider`, the best with one effect more, gives its last, or none where they
/// share little: as much as it may be larger, the member is smaller, and the data do not say how much.
std::optional<std::size_t> Selector::shares_with(const Fit& wider) const {
  const Fit& best = selection_.best;
  const Tangent tangent = tangent_of(evidence_, wider);
  const Eigen::MatrixXd C = selection_.temperature * wider.explained.covariance;
  const std::vector<Eigen::Index> own = places_of(wider, *wider.effects.back());
  const double least = k_thresholds.least_shared * evidence_.floor;
  if (own.empty() || rms_by(tangent.J(Eigen::all, own), C(own, own)) < least) return {};
  std::optional<std::size_t> most;
  double most_shared = least;
  for (std::size_t i = 0; i < best.effects.size(); ++i) {
    const std::vector<Eigen::Index> others = places_of(wider, *best.effects[i]);
    if (others.empty()) continue;
    const double shared =
        rms_by(tangent.J(Eigen::all, others), C(others, own) * solved(C(own, own), Eigen::MatrixXd(C(own, others))));
    if (shared > most_shared) most_shared = shared, most = i;
  }
  return most;
}

/// Effects that the data do not ask for, and that may be there all the same by as much as a member is smaller then,
/// join that member's group: one of them is there, and perhaps both.
void Selector::join_companions() {
  const Fit& best = selection_.best;
  if (best.effects.empty() || best.effects.size() >= k_thresholds.most_effects) return;
  const double least = score(best) - k_thresholds.as_good * selection_.temperature;
  std::vector<Addition> likely;
  for (const Addition& addition : beside_best()) {
    if (addition.promise > least && likely.size() < k_thresholds.most_rivals) likely.push_back(addition);
  }
  std::vector<Fit> fits = fitted("looking at what may be there beside it", likely, &Selector::fitted_a_little);
  for (Fit& fit : fits) {
    if (!fit.usable || !(score(fit) > least)) continue;
    const Effect* effect = fit.effects.back();
    if (const std::optional<std::size_t> place = shares_with(fit)) {
      EffectSet& members = selection_.groups[*place].members;
      if (!contains(members, *effect)) members.push_back(effect);
      companions_.push_back(fit);
    }
    keep(std::move(fit));
  }
}

/// Mean square of a number of the best about its value there, by another fit that holds it, in its steps.
std::optional<double> Selector::square_about_best(const Fit& fit, Eigen::Index place) const {
  const Fit& best = selection_.best;
  const auto own =
      std::find(fit.parameters.begin(), fit.parameters.end(), best.parameters[static_cast<std::size_t>(place)]);
  if (own == fit.parameters.end()) return {};
  const Eigen::Index k = own - fit.parameters.begin();
  const double apart = fit.x[k] - best.x[place];
  return apart * apart + selection_.temperature * std::max(0.0, fit.explained.covariance(k, k));
}

/// What a number is depends on what else is there: over all sets that hold it by their weight, and as far as any
/// companion would move it, since nobody knows whether it is there. Beside what stays unexplained it is known less
/// well.
void Selector::look_at_variance() {
  const Fit& best = selection_.best;
  const double wider = leaves_unexplained(best) ? std::pow(k_thresholds.wider_beside_rest, 2) : 1.0;
  for (std::size_t k = 0; k < best.parameters.size(); ++k) {
    const auto place = static_cast<Eigen::Index>(k);
    double squares = 0, weights = 0;
    for (const auto& [key, fit] : seen_) {
      const std::optional<double> square = square_about_best(fit, place);
      if (!square) continue;
      const double weight = std::exp((score(fit) - score(best)) / selection_.temperature);
      squares += weight * *square;
      weights += weight;
    }
    const double alone = *square_about_best(best, place);
    double variance = std::max(alone, weights > 0 ? squares / weights : alone);
    for (const Fit& companion : companions_) variance = std::max(variance, *square_about_best(companion, place));
    selection_.variance[best.parameters[k]] = {wider * alone, wider * variance};
  }
}

/// What the data say of every effect: of those that were accepted what is lost without, of the others what is gained.
void Selector::write_down() {
  const Fit& best = selection_.best;
  for (std::size_t i = 0; i < best.effects.size(); ++i) {
    Candidate candidate;
    candidate.name = best.effects[i]->name;
    candidate.accepted = true;
    candidate.why = "without it, and with the others where they are, the joint could not be simulated";
    if (selection_.without[i].usable) {
      candidate.evidence = best.log_evidence - selection_.without[i].log_evidence;
      candidate.why = "odds with it to without it " + odds(candidate.evidence);
    }
    selection_.tried.push_back(candidate);
  }
  for (const Addition& look : beside_best()) {
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
  explain_plainly();
  for (int exchanges = 0; exchanges <= k_thresholds.most_exchanges; ++exchanges) {
    take_widest();
    if (!challenge() && !exchange()) break;
  }
  for (int exchanges = 0; exchanges <= k_thresholds.most_exchanges && try_all_beside(); ++exchanges) {
    settle_best();
    if (challenge()) settle_best();
  }
  for (const auto search : {&Selector::try_pairs_from_nothing, &Selector::exchange_plainly}) {
    if (!(this->*search)()) continue;
    take_widest();
    if (challenge()) settle_best();
  }
  if (settle_rivals()) settle_best();
  drop_all_doubtful();
  complete_by_names();
  drop_what_predicts_nothing();
  join_companions();
  look_at_variance();
  write_down();
  return std::move(selection_);
}

}  // namespace

double price_of_search(const Effect& effect) { return is_searched(effect) ? k_thresholds.price_of_a_search : 0.0; }

double rareness_of(const Effect& effect) { return k_thresholds.rareness + price_of_search(effect); }

double cost_of(const Effect& effect) { return k_thresholds.price_of_a_name + price_of_search(effect); }

double rareness_of(const EffectSet& effects) {
  double sum = 0;
  for (const Effect* effect : effects) sum += rareness_of(*effect);
  return sum;
}

double score(const Fit& fit) { return score_of_names(fit) - fit.rareness_of_rest; }

Selection select_effects(const Evidence& evidence, Workers& workers, const CalibrationOptions& options) {
  return Selector(evidence, workers, options).run();
}

}  // namespace fusee
