#include "calibration/reported_parameters.h"

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

namespace fusee::calibration {
namespace {

/// Held-out mean squares, rad²: by whole runs, and by levels of load or speed.
struct HeldOutErrors {
  double runs = 0;
  double levels = 0;
};

HeldOutErrors held_out_errors(const Fit& squares) {
  return {squares.by_run.mean_square, squares.by_factor.mean_square};
}

bool is_better(const HeldOutErrors& one, const HeldOutErrors& than) {
  return one.runs < k_thresholds.least_squares_gain * than.runs && one.levels < than.levels;
}

HeldOutErrors held_out_errors_of_mode(const Evidence& evidence, const Estimate& mode, bool with_curve) {
  const auto mean_square = [&](const std::vector<Fold>& folds) {
    const HeldOutWithDiscrepancy held = hold_out_with_discrepancy(evidence, mode.fit, *mode.beside, folds);
    return (with_curve ? held.with_place : held.effects).mean_square;
  };
  return {mean_square(evidence.run_folds), mean_square(evidence.factor_folds)};
}

/// Members of groups beside the found set that a table can correct.
EffectSet table_members(const Selection& selection) {
  EffectSet all;
  for (const CredibleGroup& group : selection.groups) {
    for (const fusee::Effect* member : group.members) {
      if (member->correctable_by == CorrectableBy::table && !contains(selection.best.effects, *member) &&
          !contains(all, *member))
        all.push_back(member);
    }
  }
  return all;
}

/// The best predicting of `set` and its extensions by one of the effects, by least squares.
Fit add_best_predicting(FitterPool& pool, Fit set, const EffectSet& effects) {
  std::vector<Fit> wider(effects.size());
  pool.each(effects.size(), [&](const Fitter& fitter, std::size_t i) {
    const Fit start = fitter.add_effect(set, *effects[i]);
    if (start.usable) wider[i] = fitter.fit_least_squares(start);
  });
  const HeldOutErrors by_set = held_out_errors(set);
  for (Fit& fit : wider) {
    const bool is_best = fit.by_run.mean_square < set.by_run.mean_square;
    if (fit.usable && is_best && is_better(held_out_errors(fit), by_set)) set = std::move(fit);
  }
  return set;
}

/// Curves that stand for an unmodelled cause: for a joint declared by a ratio, one of its angle.
EffectSet unmodelled_curves(const Evidence& evidence) {
  const fusee::Effect* curve = find_effect("ratio_curve", kind_of(*evidence.declared));
  return curve == nullptr ? EffectSet{} : EffectSet{curve};
}

/// Least-squares fits of the set, perhaps with another member of a group, without and with a curve.
struct LeastSquaresFits {
  Fit reported;     ///< without a curve
  Fit handed_over;  ///< with a curve, for the correction
};

LeastSquaresFits fit_best_least_squares(const Evidence& evidence, FitterPool& pool, const Selection& selection) {
  Fit named = add_best_predicting(pool, pool.one().fit_least_squares(selection.best), table_members(selection));
  Fit with_curve = add_best_predicting(pool, named, unmodelled_curves(evidence));
  return {std::move(named), std::move(with_curve)};
}

/// Least-squares fits of the selected set, computed on first use.
class LazyLeastSquares {
 public:
  /// All must outlive this; the selection must not change.
  LazyLeastSquares(const Evidence& evidence, FitterPool& pool, const Selection& selection)
      : evidence_(evidence), pool_(pool), selection_(selection) {}

  const LeastSquaresFits& fitted() {
    if (!fitted_) fitted_ = fit_best_least_squares(evidence_, pool_, selection_);
    return *fitted_;
  }

 private:
  const Evidence& evidence_;
  FitterPool& pool_;
  const Selection& selection_;
  std::optional<LeastSquaresFits> fitted_;
};

/// Least-squares numbers, and the empirical curve of their residual. Only place and direction enter its estimate. Other
/// factors would take over a part of the curve, and the curve alone would predict less.
ReportedParameters report_least_squares(const Evidence& evidence, const LeastSquaresFits& squares) {
  ReportedParameters reported{{squares.handed_over, {}}, squares.reported, {}};
  if (!squares.handed_over.usable) return reported;
  const Fit fixed = with_fixed_parameters(evidence, squares.handed_over);
  const DiscrepancyFit residual = describe_discrepancy(evidence, fixed, is_of_place);
  if (is_unexplained(residual, evidence.floor)) reported.curve = empirical_curve(evidence, fixed, residual);
  return reported;
}

/// The declared joint, and the curve relative to its free offset.
ReportedParameters as_declared(const Estimate& declared, ReportedParameters reported) {
  const double moved = reported.estimate.fit.at.sensor.zero - declared.fit.at.sensor.zero;
  for (std::vector<double>* curve : {&reported.curve.up, &reported.curve.down}) {
    for (double& angle : *curve) angle += moved;
  }
  reported.estimate = declared;
  reported.reported = declared.fit;
  return reported;
}

/// Index of the member without which the others predict held-out rows best.
std::size_t least_needed(const Selection& selection) {
  std::size_t least = 0;
  double least_residual = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < selection.without.size(); ++i) {
    const Fit& others = selection.without[i];
    const double residual = others.by_run.mean_square + others.by_factor.mean_square;
    if (others.usable && residual < least_residual) least = i, least_residual = residual;
  }
  return least;
}

/// `squares`: least-squares fits of the same selection.
ReportedParameters best_answer(const Evidence& evidence, const Selection& selection, const DiscrepancyFit& unmodelled,
                               LazyLeastSquares& squares) {
  ReportedParameters all{{selection.best, amplitudes_beside(evidence, selection.best, unmodelled)}, selection.best, {}};
  if (!is_unexplained(unmodelled, evidence.floor) || is_walking(stroke_scatter(evidence, selection.best))) return all;
  all.curve = empirical_curve(evidence, selection.best, unmodelled);
  if (selection.best.effects.empty()) return all;
  const Fit& handed_over = squares.fitted().handed_over;
  if (!handed_over.usable ||
      !is_better(held_out_errors(handed_over), held_out_errors_of_mode(evidence, all.estimate, all.curve.used)))
    return all;
  return report_least_squares(evidence, squares.fitted());
}

bool is_beyond_model_error(Factor factor) { return factor != Factor::model_error; }

/// `answer` with the discrepancy beside its reported estimate. Beside least squares, no error of the model is assumed.
ValidatedAnswer with_residual(const Evidence& evidence, const Selection& selection, ValidatedAnswer answer) {
  const Fit& fit = answer.reported.estimate.fit;
  const bool is_mode = fit.at == selection.best.at;
  answer.residual = is_mode
                        ? answer.unmodelled
                        : describe_discrepancy(evidence, with_fixed_parameters(evidence, fit), is_beyond_model_error);
  return answer;
}

/// As validate_answer(), without the residual.
ValidatedAnswer validated(const Evidence& evidence, FitterPool& pool, const measurement::Measurement& kept,
                          Selection& selection) {
  ValidatedAnswer answer;
  answer.declared = declared_estimate(pool, selection);
  const HeldOutRows rows(evidence, answer.declared, kept);
  for (;;) {
    answer.unmodelled = describe_discrepancy(evidence, selection.best);
    LazyLeastSquares squares(evidence, pool, selection);
    answer.reported = best_answer(evidence, selection, answer.unmodelled, squares);
    if (selection.best.effects.empty()) {
      answer.reported = as_declared(answer.declared, std::move(answer.reported));
      return answer;
    }
    if (rows.worse_at(answer.reported.estimate).empty()) return answer;
    // Without discrepancy the effects keep their whole share of the error.
    ReportedParameters alone = report_least_squares(evidence, squares.fitted());
    const std::string where = alone.estimate.fit.usable ? rows.worse_at(alone.estimate) : "all rows";
    if (where.empty()) {
      answer.reported = std::move(alone);
      return answer;
    }
    const std::size_t place = least_needed(selection);
    answer.dropped.push_back(selection.best.effects[place]->name);
    drop_effect(pool, place, "with it rows that were not fitted are predicted worse than as declared: " + where,
                selection);
  }
}

}  // namespace

ReportedParameters choose_reported_parameters(const Evidence& evidence, FitterPool& pool, const Selection& selection,
                                              const DiscrepancyFit& unmodelled) {
  LazyLeastSquares squares(evidence, pool, selection);
  return best_answer(evidence, selection, unmodelled, squares);
}

ValidatedAnswer validate_answer(const Evidence& evidence, FitterPool& pool, const measurement::Measurement& kept,
                                Selection& selection) {
  ValidatedAnswer answer = validated(evidence, pool, kept, selection);
  return with_residual(evidence, selection, std::move(answer));
}

ValidatedAnswer changes_beside(const Evidence& evidence, const Selection& selection) {
  ValidatedAnswer answer;
  answer.declared = {selection.none, {}};
  answer.unmodelled = describe_discrepancy(evidence, selection.best);
  answer.reported.estimate = {selection.best, amplitudes_beside(evidence, selection.best, answer.unmodelled)};
  answer.reported.reported = selection.best;
  answer.residual = answer.unmodelled;
  return answer;
}

}  // namespace fusee::calibration
