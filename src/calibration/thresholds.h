/// \file
/// Every number by which a calibration decides, with its reason and the experiment that it stands on.
///
/// Experiments: *matrix* is tests/rig/known_truth, joints with known faults, whose outcome with these numbers stands in
/// profiles/calibration.md; *rig data* are the six joints of tests/data/rig; *bench joint* is
/// tests/calibration/selection_test.cpp. Where only a commit is named, the number came with it and the log does not say
/// what it was tried on: the matrix is what holds it since.
#pragma once

#include <cstddef>

namespace fusee {

struct Thresholds {
  // ---- when the rest is noise ----

  /// Held-out mean square, in squares of the noise floor: the floor is itself an estimate from few repeats, and a rest
  /// smaller than least_drop would not be named anyway (1 + 0.5² = 1.25). Search and verdict ask the same question:
  /// they had 1.25 and 1.35 (commit 4135d69). Rig data with their cause found: 0.91 … 1.17. Matrix, seed 1: at 1.25
  /// two joints whose effects were found (1.26 and 1.29) would be called unexplained; at 1.35 no verdict
  /// changes.
  double at_floor = 1.35;
  /// A joint that is loose nearly everywhere explains everything: play that costs more than this many squares of the
  /// floor is no explanation. Bench joint, every effect in turn (commit a87150f).
  double dearest_play = 2.0;

  // ---- what is accepted ----

  /// rms of the smallest effect worth a name, as a part of the floor: below it the model's own error may be as large.
  /// Explanations that differ by less are one: the quarter of the noise's mean square of profiles/calibration.md, "What
  /// is done with it", 7 (commits 4135d69, 34972f4).
  double least_drop = 0.5;
  /// Drop of the information criterion, with as many rows as the autocorrelation leaves: "strong" evidence in the usual
  /// scale (Kass and Raftery 1995). An F-test over rows accepts more than half of all nonsense regressors on a real
  /// residual (profiles/calibration.md, "What is done with it", 5).
  double least_bic_drop = 6.0;
  /// In standard errors over runs, beside the one-sided 95 % over strokes: strokes of one run are alike (4135d69).
  double least_t_over_runs = 1.0;
  /// Of what stands above the floor: what explains less of it is the neighbour of a cause unknown. Low enough that the
  /// smaller one of two causes passes: matrix, rows with two faults (4135d69).
  double least_share = 0.30;
  /// Sum of squares: what was measured by hand speaks against an explanation that is off by three standard
  /// uncertainties. Bench joint: a caliper splits a group (c4eabca).
  double contradicted = 9.0;

  // ---- what stands for what ----

  /// A rival takes an effect's place when it does better by this part of the floor's square: less than any data tell
  /// (34972f4).
  double better = 0.03;
  /// A rival by chords that comes within this many times the best held-out error is fitted to the end (59ead82).
  double near = 2.0;

  // ---- what is given up ----

  /// Strokes that should be alike are apart by this part of the noise within them: the joint does not repeat. Matrix,
  /// rows walking_zero and nothing_coloured_noise; bench joint: a walking zero (34972f4).
  double walks = 0.7;
  /// Where structure is left, what was found must have taken this share of all there was: else it is the neighbour of a
  /// cause unknown. Rig data: f_not_in_any_catalogue; matrix, the rows without a name. The real jaw's three effects
  /// take 97 % of its mean square (c4eabca).
  double most_of_it = 0.80;
  /// The same where strokes do not repeat (34972f4).
  double most_of_what_walks = 0.95;

  // ---- how far is looked ----

  /// One unloaded sweep bears about three numbers (profiles/calibration.md, "What to measure", 6), several runs more.
  std::size_t most_effects = 5;
  /// The best of all pairs by a linear look (59ead82): what is not among them costs a dozen simulations each.
  std::size_t most_pairs = 10;
  /// Every exchange betters the score; this bounds the wait (7f333b1).
  int most_exchanges = 4;

  // ---- slips of the file ----

  /// Beyond this many noise floors a slip that leaves noise alone, with nothing fitted, stands before effects that
  /// explain as well: the matrix's faults are seen by 15 at most.
  double slip_large = 15.0;
  /// … and before those that do not explain, where it leaves this many floors: a pulley that was made for the other
  /// sign of OE leaves a tendon slack towards the ends of the range, where rig and model are apart by 1.8.
  double slip_alone = 2.0;
  /// Else a slip undone, with nothing fitted, must leave this many times less than all effects that were found. Right
  /// files: none of rig data nor of the matrix, seeds 1 and 2, is doubted. Slips of rig joints do 3 to 7 times better (both
  /// signs of a nearly symmetric joint), 30 to 90 times (sign of OE), 700 times (a range in radians).
  double slip_gain = 3.0;
  /// Beyond this many times the floor effects beside the slip are not looked for: faults of the matrix are 3 to 15
  /// times the noise, two of them with rig data's thick pin 27, and a joint that is still the wrong one costs half a
  /// minute of search (c_backlash with a length of 40 for 120).
  double slip_far = 50.0;
  /// What leaves this many times less than all effects is said though a rest of another cause stays unexplained: rig
  /// data f_not_in_any_catalogue with OE's sign turned: 26 times.
  double slip_clear = 10.0;
  /// The same where the file as it stands could not be held against the data at all, in noise floors: f leaves 3.7.
  double slip_near = 5.0;
  /// Slips that leave no more than this many times what the best one leaves are said beside it: noise moves a floor of
  /// few repeats by as much (at_floor).
  double slip_tie = 1.25;

  // ---- what is said of the rest ----

  /// In standard errors: a one-sided 95 % test with 80 % power takes 2.5, blocks being few 2.8.
  double detectable = 2.8;
  /// Two explanations that a proposed run puts apart by this many times the noise are told apart by it.
  double told_apart = 3.0;
};

inline constexpr Thresholds k_thresholds{};

}  // namespace fusee
