#include "calibration/delivered.h"

#include "calibration/held_out.h"
#include "calibration/intervals.h"
#include "calibration/thresholds.h"

// Beside something without a name the summit says what the numbers are, and leaves to what has no name what that may
// explain as well. What a file hands over is to foretell: where runs that were left out are foretold better by numbers
// of least squares that the intervals hold, nothing speaks for the others.

namespace fusee {
namespace {

/// Mean squares of what was left out, rad²: whole runs, and levels of load or speed.
struct Foretold {
  double runs = 0;
  double levels = 0;
};

Foretold foretold_by_summit(const Evidence& evidence, const Fit& fit, const Unnamed& unnamed, bool with_curve) {
  const Amplitudes amplitudes = amplitudes_beside(evidence, fit, unnamed);
  const auto left = [&](const std::vector<Fold>& folds) {
    const HeldOutBeside held = hold_out_beside(evidence, fit, amplitudes, folds);
    return (with_curve ? held.with_place : held.effects).mean_square;
  };
  return {left(evidence.run_folds), left(evidence.factor_folds)};
}

}  // namespace

Delivered delivered(const Evidence& evidence, Workers& workers, const Selection& selection, const Unnamed& unnamed) {
  Delivered all{selection.best, {}};
  if (!is_unexplained(unnamed, evidence.floor) || is_walking(stroke_scatter(evidence, selection.best))) return all;
  all.curve = empirical_curve(evidence, selection.best, unnamed);
  if (selection.best.effects.empty()) return all;
  Fit squares = workers.one().by_squares(selection.best, intervals(selection));
  if (!squares.usable) return all;
  const Foretold summit = foretold_by_summit(evidence, selection.best, unnamed, all.curve.used);
  const bool is_better = squares.by_run.mean_square < k_thresholds.least_squares_left * summit.runs &&
                         squares.by_factor.mean_square < summit.levels;
  if (!is_better) return all;
  all.fit = std::move(squares);
  all.curve.used = false;
  all.curve.why = "the effects' numbers take away more than it would of runs that they were not fitted to";
  return all;
}

}  // namespace fusee
