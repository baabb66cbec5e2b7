/// \file
/// Validation by prediction: an answer must predict held-out rows at least as well as the declared joint.
#pragma once

#include <optional>
#include <string>
#include <vector>

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

}  // namespace fusee::calibration
