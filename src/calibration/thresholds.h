/// \file
/// Thresholds of the decisions of a calibration, each with its reason and the figure that supports it.
///
/// docs/development/calibration-ablation.md reports which of them were switched off on joints that nothing was tuned
/// on, and the cost. *Rig data* are the six joints of tests/data/rig. "Joints" without a place are joints of
/// tests/rig/known_truth. An effect is held if a reported group contains it. A false positive is a group without a true
/// cause. Evidence is in natural logarithms (nats). Constants of a numerical method are where it is.
#pragma once

namespace fusee::calibration {

struct Thresholds {
  // ---- standards that all decisions share ----

  /// Nats of strong evidence, odds of 20 : 1 (Kass and Raftery 1995): what each component of a described discrepancy
  /// must add, and the penalty of a searched number (an order, a time) beside the prior odds.
  double strong = 3.0;
  /// Nats of decisive evidence, odds of 400 : 1: what one effect requires by itself (audit, detectable sizes), what makes
  /// a residual unexplained, and below what absence probability a group is complete.
  double decisive = 6.0;
  /// Standard errors that a difference must exceed: of noise levels, of a proposed run, of an empirical curve's gain.
  double sure = 3.0;
  /// Largest false-positive rate of an effect that is reported alone, and its largest absence probability. Two sets are
  /// equally likely up to odds of its inverse.
  double most_false_positives = 0.02;

  // ---- residual: noise, or an unmodelled cause ----

  /// An effect explains a part of the residual if it lowers the residual to this share. Joint 950018: without this rule
  /// an uncertain offset is dropped, 4.4 noise floors remain in place of 2, and the held-out error is 2.0 times as
  /// large. Input errors whose residuals differ by less are equally likely.
  double residual_share = 0.8;

  // ---- evidence of a set of effects ----

  /// Relative error of the model itself, as a share of the declared joint's deflection. Smaller errors are no evidence,
  /// however long the log is.
  double model_error = 0.03;
  /// Negative log prior odds of an effect: of 26 effects a joint has two or three. A discrepancy of one noise floor rms
  /// and more has the same penalty, a smaller one less.
  double neg_log_prior_odds = 2.3;
  /// Prior scale of a discrepancy's family, in noise floors: one in two is larger. Smaller discrepancies are not
  /// described, and leave nothing unexplained. 150 joints: without this prior 50 %
  /// of the effects are held, with it 75 %; false positives beside an unmodelled cause are 18 % and 25 %.
  double usual_discrepancy = 0.5;
  /// Limits of the prior size of a number: it moves the reading by at most `most_expected` times the observed error, or
  /// `least_expected` noise floors if those are larger.
  double most_expected = 2.0;
  double least_expected = 10.0;
  /// Divisor of log odds, since evidence is overstated if the model is slightly wrong. 296 joints: at 1.0, 1.5, 2.2 and
  /// 3.2 false positives are 54, 46, 39 and 31 of 160 joints with an unmodelled cause; 229, 229, 228 and 235 effects
  /// are held; from 2.0 on stretch is no longer found from seven dwells.
  double temperature = 1.75;
  /// Degrees of freedom of the noise floor as a prior of the noise. A floor with fewer is badly known.
  double noise_freedom = 30.0;

  // ---- reported effects ----

  /// Absence probability above which an effect is not reported. Between the false-positive rate and this, its group
  /// contains `unmodelled`. 48 joints: of 10 effects that were lost 6 were in the likeliest set.
  double most_absence_probability = 0.3;
  /// Share of the absence probability that each further member of a group must remove. Without it groups of 9 joints
  /// from seed 950001 have 7.2 members in place of 5.7.
  double least_gain = 0.1;
  /// An effect beside the best set joins a member's group if both can exchange at least this much, rms in noise floors.
  /// Without this step 8 of 10 effects of the joints named above are held in place of 10.
  double least_shared = 1.5;
  /// Log odds of an effect against the best unmodelled cause in its place (unmodelled_alternatives.h) below which its
  /// group contains `unmodelled`.
  double ahead_of_unmodelled = 10.0;
  /// Log odds that are required of an effect without a shape of its own. It follows temperature or begins at some time,
  /// as wear, settling and jumps do; or it leaves the joint free within a play. 670 joints: of six thermal expansions
  /// at 15 to 40 nats three were false positives, of eight above 40 one; of six slacks below 40 three, above none.
  double ahead_without_shape = 40.0;
  /// Factor on intervals beside an unexplained residual. 204 joints: 88 % of 95 numbers were within intervals without
  /// it.
  double interval_factor = 1.5;
  /// Beside an unmodelled cause, largest ratio of held-out mean squares, least squares to MAP, at which least squares
  /// are reported. Set on the real jaw: 0.93 by runs, 0.91 by levels.
  double least_squares_gain = 0.95;

  // ---- joints that do not repeat ----

  /// Largest scatter between repeated strokes, divided by the noise within a stroke.
  double most_stroke_scatter = 0.7;
  /// Largest scatter of repeats, divided by the scatter of neighbouring rows. Noise with a memory of 0.95 from row to
  /// row reaches 6, of 0.98 reaches 9.
  double most_repeat_scatter = 10.0;

  // ---- two states of one joint ----

  /// Share of the shorter range of α that both states must cover, and share of the motion, rms, by which they may
  /// differ. Half the ratio differs by 0.5.
  double joint_share = 0.3;
  /// Size of a change in standard errors, by the scatter from run to run. Jaw, state Pitch_1, its runs taken in turn as
  /// before and after: without it tendon_stretch and tendon_slip are reported.
  double least_by_runs = 5.0;

  // ---- likely input errors ----

  /// Residual of the declared file, in noise floors, above which an input error is likely before any search. Known
  /// faults leave 15, one of them 27. The corrected file must leave less, if effects are sought beside the error. The
  /// same ratio of both reports an error beside which another cause stays unexplained. Rig data
  /// f_not_in_any_catalogue with the sign of OE turned: 26.
  double input_error_large = 15.0;
  /// Residual of the corrected file, in noise floors, up to which it explains the data alone. A pulley made for the
  /// other sign of OE leaves 1.8 where a tendon goes slack. Above it, the corrected file, with nothing fitted, must leave
  /// a residual this many times smaller than all identified effects do. Rig data: errors leave 3 to 7 times less (signs of a nearly symmetric joint) to
  /// 700 times less; no right file is reported.
  double input_error_gain = 3.0;
};

inline constexpr Thresholds k_thresholds{};

}  // namespace fusee::calibration
