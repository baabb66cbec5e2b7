#include "calibration/validation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "calibration/held_out.h"
#include "calibration/thresholds.h"
#include "fusee/joint.h"

// Beside a significant discrepancy the MAP estimate may attribute a part of an effect to the discrepancy. Least squares
// are reported if they predict held-out rows better. A group may have two members present: a second member is included
// if the prediction improves further, and the group stays. Effects that the pulley corrects are never included that
// way, since a part is made from them.

namespace fusee::calibration {
namespace {

/// Standard errors over strokes by which a level may get worse by chance.
constexpr double k_errors_by_chance = 2.0;
/// Rows of a run that was kept for validation.
constexpr std::size_t k_rows_a_kept_run = 400;

std::string names_of(const Evidence& evidence, const Fold& fold) {
  std::string text;
  for (const std::string& name : evidence.run_names(fold)) text += (text.empty() ? "" : ", ") + name;
  return text;
}

double mean_square(const measurement::Run& run, const measurement::Stroke& stroke, const std::vector<double>& model,
                   double& rows) {
  double squares = 0;
  rows = 0;
  for (std::size_t i = stroke.first; i <= stroke.last; ++i) {
    const double error = run.samples[i].theta - model[i];
    if (!std::isfinite(error)) continue;
    squares += error * error;
    rows += 1;
  }
  return rows > 0 ? squares / rows : 0.0;
}

}  // namespace

Estimate declared_estimate(FitterPool& pool, const Selection& selection) {
  if (selection.none.x.size() == 0) return {selection.none, {}};
  Fit fit = pool.one().fit_least_squares(selection.none);
  return {fit.usable ? fit : selection.none, {}};
}

HeldOut hold_out(const Evidence& evidence, const Estimate& estimate, const std::vector<Fold>& folds) {
  if (estimate.beside) return hold_out_with_discrepancy(evidence, estimate.fit, *estimate.beside, folds).effects;
  return hold_out(evidence, estimate.fit, folds);
}

std::vector<Imperfections> estimates_without(const Evidence& evidence, const Estimate& estimate,
                                             const std::vector<Fold>& folds) {
  const Fit& fit = estimate.fit;
  const Amplitudes* beside = estimate.beside ? &*estimate.beside : nullptr;
  std::vector<Imperfections> all;
  for (const Eigen::VectorXd& x : numbers_without(evidence, fit, beside, folds)) {
    Imperfections at = fit.at;
    for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
      const EffectParameter& parameter = *fit.parameters[k];
      const double value = x[static_cast<Eigen::Index>(k)] * parameter.step;
      set_value(at, parameter, std::clamp(value, parameter.least, parameter.most));
    }
    all.push_back(at);
  }
  return all;
}

HeldOutRows::HeldOutRows(const Evidence& evidence, const Estimate& declared, measurement::Measurement kept)
    : evidence_(evidence), declared_(declared), kept_(with_fewer_rows(std::move(kept), k_rows_a_kept_run)) {}

HeldOutRows::Level HeldOutRows::level_of(const std::string& name, const Fold& fold, const HeldOut& before,
                                         const HeldOut& after) const {
  Level level{name, {}};
  for (const std::size_t b : fold) {
    const Block block{static_cast<double>(evidence_.blocks[b].rows.size()), before.by_block[b], after.by_block[b]};
    if (std::isfinite(block.before) && std::isfinite(block.after)) level.blocks.push_back(block);
  }
  return level;
}

std::vector<HeldOutRows::Level> HeldOutRows::left_out(const std::vector<Fold>& folds, const Estimate& answer) const {
  const HeldOut before = hold_out(evidence_, declared_, folds), after = hold_out(evidence_, answer, folds);
  std::vector<Level> levels;
  for (const Fold& fold : folds) levels.push_back(level_of(names_of(evidence_, fold), fold, before, after));
  return levels;
}

/// Levels of the kept runs: each run has its load and speed.
std::vector<HeldOutRows::Level> HeldOutRows::kept_apart(const Estimate& answer) const {
  const joint::BenchLog log = measurement::bench_log(kept_);
  const joint::Readings before = joint::predict(*evidence_.declared, declared_.fit.at, log),
                        after = joint::predict(*evidence_.declared, answer.fit.at, log);
  std::vector<Level> levels;
  for (std::size_t r = 0; r < kept_.runs.size(); ++r) {
    const measurement::Run& run = kept_.runs[r];
    Level& level = levels.emplace_back(Level{run.name, {}});
    for (const measurement::Stroke& stroke : run.strokes) {
      Block block;
      if (stroke.partial) continue;
      block.before = mean_square(run, stroke, before[r], block.rows);
      block.after = mean_square(run, stroke, after[r], block.rows);
      if (block.rows > 0) level.blocks.push_back(block);
    }
  }
  return levels;
}

HeldOutRows::Block HeldOutRows::sum_of(const std::vector<Block>& blocks) {
  Block sum;
  for (const Block& block : blocks) {
    sum.rows += block.rows;
    sum.before += block.rows * block.before;
    sum.after += block.rows * block.after;
  }
  return sum;
}

/// Standard error of the mean change of the squares, by its scatter between blocks, rad².
double HeldOutRows::standard_error(const std::vector<Block>& blocks) {
  const Block sum = sum_of(blocks);
  const double more = (sum.after - sum.before) / sum.rows;
  const auto count = static_cast<double>(blocks.size());
  double squares = 0;
  for (const Block& block : blocks)
    squares += elementary::pow(block.rows * (block.after - block.before - more) / sum.rows, 2);
  return std::sqrt(squares * count / (count - 1.0));
}

/// True if the squares rise by more than is visible and by more than strokes scatter; a single stroke is compared with
/// the scatter of `all` levels.
bool HeldOutRows::gets_worse(const Level& level, const Level& all) const {
  const Block sum = sum_of(level.blocks);
  if (sum.rows == 0) return false;
  const double more = (sum.after - sum.before) / sum.rows;
  if (more <= elementary::pow(k_thresholds.usual_discrepancy * evidence_.floor, 2)) return false;
  if (all.blocks.size() < 2) return true;
  const double error = level.blocks.size() > 1
                           ? standard_error(level.blocks)
                           : standard_error(all.blocks) * std::sqrt(sum_of(all.blocks).rows / sum.rows);
  return more > k_errors_by_chance * error;
}

std::string HeldOutRows::worse_among(const std::vector<Level>& levels) const {
  Level all{"all rows", {}};
  for (const Level& level : levels) all.blocks.insert(all.blocks.end(), level.blocks.begin(), level.blocks.end());
  if (gets_worse(all, all)) return all.name;
  const auto worse =
      std::find_if(levels.begin(), levels.end(), [&](const Level& level) { return gets_worse(level, all); });
  return worse == levels.end() ? "" : worse->name;
}

std::string HeldOutRows::worse_at(const Estimate& answer) const {
  std::vector<std::vector<Level>> all = {left_out(evidence_.run_folds, answer),
                                         left_out(evidence_.factor_folds, answer)};
  if (!kept_.runs.empty()) all.push_back(kept_apart(answer));
  for (const std::vector<Level>& levels : all) {
    if (std::string where = worse_among(levels); !where.empty()) return where;
  }
  return "";
}

void drop_effect(FitterPool& pool, std::size_t place, const std::string& why, Selection& selection) {
  const fusee::Effect* gone = selection.best.effects[place];
  const EffectSet before = selection.best.effects;
  const std::vector<CredibleGroup> groups = std::move(selection.groups);
  selection.best = selection.without[place].usable ? selection.without[place] : selection.none;
  selection.groups.clear();
  for (const fusee::Effect* effect : selection.best.effects) {
    const auto own = static_cast<std::size_t>(std::find(before.begin(), before.end(), effect) - before.begin());
    selection.groups.push_back(groups[own]);
  }
  std::erase_if(selection.rivals,
                [&](const Rival& rival) { return !contains(selection.best.effects, *rival.accepted); });
  const Fit& best = selection.best;
  selection.without.assign(best.effects.size(), {});
  pool.each(best.effects.size(), [&](const Fitter& fitter, std::size_t i) {
    const fusee::Effect& effect = *best.effects[i];
    selection.without[i] = fitter.fit(without(best.effects, effect), without(best.at, effect));
  });
  for (Candidate& candidate : selection.tried) {
    if (contains(best.effects, *gone) || candidate.name != gone->name) continue;
    candidate.accepted = false;
    candidate.why = why;
  }
}

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

/// Members and companions of groups beside the found set that a table or the sensor can correct.
EffectSet members_without_pulley(const Selection& selection) {
  EffectSet all;
  for (const CredibleGroup& group : selection.groups) {
    for (const EffectSet* effects : {&group.members, &group.companions}) {
      for (const fusee::Effect* one : *effects) {
        const bool is_correctable =
            one->correctable_by == CorrectableBy::table || one->place == ChainPlace::joint_sensor;
        if (is_correctable && !contains(selection.best.effects, *one) && !contains(all, *one)) all.push_back(one);
      }
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
  Fit named =
      add_best_predicting(pool, pool.one().fit_least_squares(selection.best), members_without_pulley(selection));
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
