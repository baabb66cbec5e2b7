/// \file
/// Choice of the reported parameters: those that predict held-out rows best, and never worse than the declared joint.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/empirical_curve.h"
#include "calibration/selection.h"

namespace fusee::calibration {

/// Parameters of a set of effects, and their estimator.
struct Estimate {
  Fit fit;
  std::optional<Amplitudes> beside;  ///< amplitudes of the discrepancy estimated with them; none: by least squares
};

/// The declared joint, with its free offset by least squares.
Estimate declared_estimate(FitterPool& pool, const Selection& selection);

/// Held-out errors of the effects, without the discrepancy that was estimated with them.
HeldOut hold_out(const Evidence& evidence, const Estimate& estimate, const std::vector<Fold>& folds);

/// The joint refitted without each of the folds.
std::vector<Imperfections> estimates_without(const Evidence& evidence, const Estimate& estimate,
                                             const std::vector<Fold>& folds);

/// Held-out rows: folds of the evidence, and runs kept for validation.
class HeldOutRows {
 public:
  /// `kept` may have no runs. All must outlive this.
  HeldOutRows(const Evidence& evidence, const Estimate& declared, measurement::Measurement kept);

  /// Rows that the answer predicts worse than the declared joint, by more than the scatter between strokes: "all rows",
  /// or the runs of one level of load or speed ("run_3.csv"). Empty if there are none.
  std::string worse_at(const Estimate& answer) const;

 private:
  struct Block {
    double rows = 0;
    double before = 0, after = 0;  ///< mean squares, rad²
  };
  struct Level {
    std::string name;
    std::vector<Block> blocks;
  };
  Level level_of(const std::string& name, const Fold& fold, const HeldOut& before, const HeldOut& after) const;
  std::vector<Level> left_out(const std::vector<Fold>& folds, const Estimate& answer) const;
  std::vector<Level> kept_apart(const Estimate& answer) const;
  std::string worse_among(const std::vector<Level>& levels) const;
  static Block sum_of(const std::vector<Block>& blocks);
  static double standard_error(const std::vector<Block>& blocks);
  bool gets_worse(const Level& level, const Level& all) const;

  const Evidence& evidence_;
  const Estimate& declared_;
  measurement::Measurement kept_;
};

/// Removes the effect at `place` of the best set. The other effects take the values of the fit without it. `why` is
/// recorded in Selection::tried.
void drop_effect(FitterPool& pool, std::size_t place, const std::string& why, Selection& selection);

struct ReportedParameters {
  /// The found set, perhaps with another member of a group; without effects the declared joint.
  Estimate estimate;
  /// Parameters in the report. If the estimate contains a curve of the ratio, they are fitted without it, since the
  /// curve is collinear with gain and compliance.
  Fit reported;
  EmpiricalCurve curve;  ///< curve of the remaining discrepancy
};

/// `unmodelled`: description of the discrepancy beside selection.best.
ReportedParameters choose_reported_parameters(const Evidence& evidence, FitterPool& pool, const Selection& selection,
                                              const DiscrepancyFit& unmodelled);

/// Answer that is reported.
struct ValidatedAnswer {
  Estimate declared;  ///< declared joint
  ReportedParameters reported;
  DiscrepancyFit unmodelled;  ///< discrepancy beside selection.best: decides whether the effects explain the data
  DiscrepancyFit residual;    ///< discrepancy beside the reported estimate: is described
  /// effects that fit the runs and do not predict held-out rows, in the order of their removal
  std::vector<std::string> dropped;
};

/// Removes effects from `selection`, the least predictive first, until held-out rows are predicted no worse than by the
/// declared joint, over all and at each level of load and speed. `kept`: runs for validation.
ValidatedAnswer validate_answer(const Evidence& evidence, FitterPool& pool, const measurement::Measurement& kept,
                                Selection& selection);

/// Changes between two states, as selected, beside the discrepancy that both states share. They are not validated by
/// prediction: every run has the discrepancy of the earlier state.
ValidatedAnswer changes_beside(const Evidence& evidence, const Selection& selection);

}  // namespace fusee::calibration
