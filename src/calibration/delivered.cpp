#include "calibration/delivered.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "calibration/held_out.h"
#include "calibration/thresholds.h"

// Beside a significant discrepancy the MAP estimate may attribute a part of an effect to the discrepancy. Least squares
// are reported if they predict held-out rows better. A group may have two members present: a second member is included
// if the prediction improves further, and the group stays. Effects that the pulley corrects are never included that
// way, since a part is made from them.

namespace fusee {
namespace {

/// Held-out mean squares, rad²: by whole runs, and by levels of load or speed.
struct Foretold {
  double runs = 0;
  double levels = 0;
};

Foretold foretold(const Fit& squares) { return {squares.by_run.mean_square, squares.by_factor.mean_square}; }

bool is_better(const Foretold& one, const Foretold& than) {
  return one.runs < k_thresholds.least_squares_left * than.runs && one.levels < than.levels;
}

Foretold foretold_by_summit(const Evidence& evidence, const Estimate& summit, bool with_curve) {
  const auto left = [&](const std::vector<Fold>& folds) {
    const HeldOutBeside held = hold_out_beside(evidence, summit.fit, *summit.beside, folds);
    return (with_curve ? held.with_place : held.effects).mean_square;
  };
  return {left(evidence.run_folds), left(evidence.factor_folds)};
}

/// Members of groups beside the found set that a table can correct.
EffectSet perhaps_beside(const Selection& selection) {
  EffectSet all;
  for (const CredibleGroup& group : selection.groups) {
    for (const Effect* member : group.members) {
      if (member->correctable_by == CorrectableBy::table && !contains(selection.best.effects, *member) &&
          !contains(all, *member))
        all.push_back(member);
    }
  }
  return all;
}

/// The best predicting of `set` and its extensions by one of the effects, by least squares.
Fit or_with_one_more(Workers& workers, Fit set, const EffectSet& effects) {
  std::vector<Fit> wider(effects.size());
  workers.each(effects.size(), [&](const Fitter& fitter, std::size_t i) {
    const Fit start = fitter.with_effect(set, *effects[i]);
    if (start.usable) wider[i] = fitter.by_squares(start);
  });
  const Foretold by_set = foretold(set);
  for (Fit& fit : wider) {
    const bool is_best = fit.by_run.mean_square < set.by_run.mean_square;
    if (fit.usable && is_best && is_better(foretold(fit), by_set)) set = std::move(fit);
  }
  return set;
}

/// Curves that stand for an unmodelled cause: for a joint declared by a ratio, one of its angle.
EffectSet unmodelled_curves(const Evidence& evidence) {
  const Effect* curve = find_effect("ratio_curve", kind_of(*evidence.declared));
  return curve == nullptr ? EffectSet{} : EffectSet{curve};
}

/// Least-squares fits of the set, perhaps with another member of a group, without and with a curve.
struct BySquares {
  Fit reported;
  Fit handed_over;
};

BySquares best_by_squares(const Evidence& evidence, Workers& workers, const Selection& selection) {
  Fit named = or_with_one_more(workers, workers.one().by_squares(selection.best), perhaps_beside(selection));
  Fit with_curve = or_with_one_more(workers, named, unmodelled_curves(evidence));
  return {std::move(named), std::move(with_curve)};
}

/// Least-squares fits of the selected set, computed on first use.
class SquaresOfSelection {
 public:
  /// All must outlive this; the selection must not change.
  SquaresOfSelection(const Evidence& evidence, Workers& workers, const Selection& selection)
      : evidence_(evidence), workers_(workers), selection_(selection) {}

  const BySquares& fitted() {
    if (!fitted_) fitted_ = best_by_squares(evidence_, workers_, selection_);
    return *fitted_;
  }

 private:
  const Evidence& evidence_;
  Workers& workers_;
  const Selection& selection_;
  std::optional<BySquares> fitted_;
};

/// Least-squares parameters have no empirical curve.
Delivered by_squares(const Evidence& evidence, const BySquares& squares, const Unnamed& unnamed) {
  Delivered made{{squares.handed_over, {}}, squares.reported, {}};
  if (made.estimate.fit.at.ratio_joint.curve != RatioCurve{})
    made.curve.why = "the identified joint contains the dependence on the angle, as a curve of its ratio";
  else if (is_unexplained(unnamed, evidence.floor))
    made.curve.why = "the effects' numbers take away more than it would of runs that they were not fitted to";
  return made;
}

/// The declared joint, and the curve relative to its free offset.
Delivered as_declared(const Estimate& declared, Delivered made) {
  const double moved = made.estimate.fit.at.sensor.zero - declared.fit.at.sensor.zero;
  for (std::vector<double>* curve : {&made.curve.up, &made.curve.down}) {
    for (double& angle : *curve) angle += moved;
  }
  made.estimate = declared;
  made.reported = declared.fit;
  return made;
}

/// Index of the member without which the others predict held-out rows best.
std::size_t least_needed(const Selection& selection) {
  std::size_t least = 0;
  double least_left = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < selection.without.size(); ++i) {
    const Fit& others = selection.without[i];
    const double left = others.by_run.mean_square + others.by_factor.mean_square;
    if (others.usable && left < least_left) least = i, least_left = left;
  }
  return least;
}

/// `squares`: least-squares fits of the same selection.
Delivered best_answer(const Evidence& evidence, const Selection& selection, const Unnamed& unnamed,
                      SquaresOfSelection& squares) {
  Delivered all{{selection.best, amplitudes_beside(evidence, selection.best, unnamed)}, selection.best, {}};
  if (!is_unexplained(unnamed, evidence.floor) || is_walking(stroke_scatter(evidence, selection.best))) return all;
  all.curve = empirical_curve(evidence, selection.best, unnamed);
  if (selection.best.effects.empty()) return all;
  const Fit& handed_over = squares.fitted().handed_over;
  if (!handed_over.usable ||
      !is_better(foretold(handed_over), foretold_by_summit(evidence, all.estimate, all.curve.used)))
    return all;
  return by_squares(evidence, squares.fitted(), unnamed);
}

}  // namespace

Delivered delivered(const Evidence& evidence, Workers& workers, const Selection& selection, const Unnamed& unnamed) {
  SquaresOfSelection squares(evidence, workers, selection);
  return best_answer(evidence, selection, unnamed, squares);
}

Validated validated(const Evidence& evidence, Workers& workers, const Measurement& kept, Selection& selection) {
  Validated answer;
  answer.declared = declared_estimate(workers, selection);
  const HeldOutRows rows(evidence, answer.declared, kept);
  for (;;) {
    answer.unnamed = unnamed_beside(evidence, selection.best);
    SquaresOfSelection squares(evidence, workers, selection);
    answer.made = best_answer(evidence, selection, answer.unnamed, squares);
    if (selection.best.effects.empty()) {
      answer.made = as_declared(answer.declared, std::move(answer.made));
      return answer;
    }
    if (rows.worse_at(answer.made.estimate).empty()) return answer;
    // Without discrepancy the effects keep their whole share of the error.
    Delivered alone = by_squares(evidence, squares.fitted(), answer.unnamed);
    const std::string where = alone.estimate.fit.usable ? rows.worse_at(alone.estimate) : "all rows";
    if (where.empty()) {
      answer.made = std::move(alone);
      return answer;
    }
    const std::size_t place = least_needed(selection);
    answer.dropped.push_back(selection.best.effects[place]->name);
    drop_effect(workers, place, "with it rows that were not fitted are predicted worse than as declared: " + where,
                selection);
  }
}

Validated changes_beside(const Evidence& evidence, const Selection& selection) {
  Validated answer;
  answer.declared = {selection.none, {}};
  answer.unnamed = unnamed_beside(evidence, selection.best);
  answer.made.estimate = {selection.best, amplitudes_beside(evidence, selection.best, answer.unnamed)};
  answer.made.reported = selection.best;
  return answer;
}

}  // namespace fusee
