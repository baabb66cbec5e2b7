#include "calibration/delivered.h"

#include <algorithm>

#include "calibration/held_out.h"
#include "calibration/intervals.h"
#include "calibration/thresholds.h"

// Beside something without a name the summit says what the numbers are, and leaves to what has no name what that may
// explain as well. What a file hands over is to foretell: where runs that were left out are foretold better by numbers
// of least squares that the intervals hold, nothing speaks for the others. Of a group one member is there, and perhaps
// another beside it: where they are foretold better still by both, both are handed over, and the group stays a group.
// What a pulley would take out is not handed over so: nobody cuts metal for a perhaps.

namespace fusee {
namespace {

/// Mean squares of what was left out, rad²: whole runs, and levels of load or speed.
struct Foretold {
  double runs = 0;
  double levels = 0;
};

bool is_better(const Fit& fit, const Foretold& than) {
  return fit.by_run.mean_square < k_thresholds.least_squares_left * than.runs &&
         fit.by_factor.mean_square < than.levels;
}

Foretold foretold_by_summit(const Evidence& evidence, const Fit& fit, const Unnamed& unnamed, bool with_curve) {
  const Amplitudes amplitudes = amplitudes_beside(evidence, fit, unnamed);
  const auto left = [&](const std::vector<Fold>& folds) {
    const HeldOutBeside held = hold_out_beside(evidence, fit, amplitudes, folds);
    return (with_curve ? held.with_place : held.effects).mean_square;
  };
  return {left(evidence.run_folds), left(evidence.factor_folds)};
}

/// Effects that groups say may be there beside the set that was found, and that a table takes out.
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

/// Of the set, or with one effect more: that one's numbers within its own intervals. The one that foretells best.
Fit best_by_squares(Workers& workers, const Selection& selection) {
  const std::vector<ConfidenceInterval> own = intervals(selection);
  Fit best = workers.one().by_squares(selection.best, own);
  const EffectSet perhaps = perhaps_beside(selection);
  std::vector<Fit> wider(perhaps.size());
  workers.each(perhaps.size(), [&](const Fitter& fitter, std::size_t i) {
    const Fit start = fitter.with_effect(selection.best, *perhaps[i]);
    if (!start.usable) return;
    std::vector<ConfidenceInterval> ranges = intervals(start);
    std::copy(own.begin(), own.end(), ranges.begin());
    wider[i] = fitter.by_squares(start, ranges);
  });
  const Foretold by_set{best.by_run.mean_square, best.by_factor.mean_square};
  for (Fit& fit : wider) {
    const bool is_best = fit.by_run.mean_square < best.by_run.mean_square;
    if (fit.usable && is_best && is_better(fit, by_set)) best = std::move(fit);
  }
  return best;
}

}  // namespace

Delivered delivered(const Evidence& evidence, Workers& workers, const Selection& selection, const Unnamed& unnamed) {
  Delivered all{selection.best, {}};
  if (!is_unexplained(unnamed, evidence.floor) || is_walking(stroke_scatter(evidence, selection.best))) return all;
  all.curve = empirical_curve(evidence, selection.best, unnamed);
  if (selection.best.effects.empty()) return all;
  Fit squares = best_by_squares(workers, selection);
  if (!squares.usable) return all;
  const Foretold summit = foretold_by_summit(evidence, selection.best, unnamed, all.curve.used);
  if (!is_better(squares, summit)) return all;
  all.fit = std::move(squares);
  all.curve.used = false;
  all.curve.why = "the effects' numbers take away more than it would of runs that they were not fitted to";
  return all;
}

}  // namespace fusee
