/// \file
/// Validation by prediction: an answer stands only where it predicts rows that it was not fitted to at least as well as
/// the declared joint does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/selection.h"

namespace fusee {

/// Numbers of a set of effects, and how they are estimated.
struct Estimate {
  Fit fit;
  std::optional<Amplitudes> beside;  ///< of the discrepancy that is estimated with them; none: by least squares
};

/// The declared joint: its free offset by least squares, and nothing else fitted.
Estimate declared_estimate(Workers& workers, const Selection& selection);

/// Errors of the effects alone on blocks that were left out, as hold_out().
HeldOut hold_out(const Evidence& evidence, const Estimate& estimate, const std::vector<Fold>& folds);

/// The joint as the rows outside each of the folds have it.
std::vector<Imperfections> estimates_without(const Evidence& evidence, const Estimate& estimate,
                                             const std::vector<Fold>& folds);

/// Rows that an answer is not fitted to: folds of the evidence, and runs that were kept for validation.
class HeldOutRows {
 public:
  /// `kept` may have no runs. All must outlive this.
  HeldOutRows(const Evidence& evidence, const Estimate& declared, Measurement kept);

  /// The rows on which the answer predicts worse than the declared joint by more than strokes differ: on all of them ("all rows"),
  /// or on one level of load or speed ("run_3.csv"). Empty: nowhere.
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
  Measurement kept_;
};

/// Removes the effect at `place` of the best set; the others are as they were fitted without it. `why` stands beside
/// its name in Selection::tried.
void drop_effect(Workers& workers, std::size_t place, const std::string& why, Selection& selection);

}  // namespace fusee
