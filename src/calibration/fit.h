/// \file
/// Fits of a set of effects, and their prediction of held-out rows. Strokes are the sample, not rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibration/held_out.h"
#include "calibration/marginal.h"
#include "calibration/model.h"
#include "calibration/normal_equations.h"

namespace fusee {

/// Fit of a set of effects, with its evidence and held-out errors.
struct Fit {
  EffectSet effects;
  Parameters parameters;  ///< parameters in the order of x
  Imperfections at;
  Eigen::VectorXd x;  ///< parameters, each divided by its step
  Eigen::MatrixXd J;  ///< dθ/dx at the rows of all runs
  LooseRow rest = LooseRow::anywhere;
  Eigen::VectorXd residual;  ///< residual as Evaluation
  Eigen::VectorXd loose;
  std::vector<NormalEquations> sums;  ///< sums of each block
  NormalEquations readings;           ///< sums of caliper readings, in the same unit
  HeldOut by_factor;                  ///< held-out error by Evidence::factor_folds: decides
  HeldOut by_run;                     ///< held-out error by Evidence::run_folds: is reported
  double mean_square = 0;             ///< mean square of the fitted rows, with `play_square`
  double price = 0;                   ///< part of every mean square that corrects for the play of a loose joint, rad²
  double against_readings = 0;        ///< χ² of the caliper readings
  Explained explained;                ///< posterior with the discrepancy marginalised
  double log_evidence = 0;            ///< log evidence of the set, loose rows corrected for; the larger is the likelier
  double rareness_of_rest = 0;        ///< prior penalty of the remaining discrepancy, nats
  bool usable = false;
};

/// Held-out mean square of the residual, by runs, without the play correction, rad².
inline double held_out_square(const Fit& fit) { return std::max(0.0, fit.by_run.mean_square - fit.price); }
/// Root of held_out_square(), rad.
inline double held_out_rms(const Fit& fit) { return std::sqrt(held_out_square(fit)); }

/// Fixes each parameter that is at a bound, in every subset of the data: its slopes become 0.
void hold_at_bounds(Fit& fit);

/// Indices of an effect's parameters in the fit.
std::vector<Eigen::Index> places_of(const Fit& fit, const Effect& effect);

/// Fits the joint to the evidence, the discrepancy marginalised. For one thread.
class Fitter {
 public:
  Fitter(const Evidence& evidence, Forward& forward) : model_(evidence, forward) {}

  /// Full fit from the parameters of `from`.
  Fit fit(const EffectSet& effects, const Imperfections& from) const;

  /// Least-squares fit of the same set from there, as hold_out() fits: no prior sizes, no discrepancy.
  Fit by_squares(const Fit& fit) const;

  /// `base` with one effect more, from the best of its starts, close to the optimum: for the comparison of candidates.
  /// Fitted from the likeliest start beside the discrepancy, and from the likeliest start without discrepancy. If the
  /// discrepancy explains everything, all starts beside it are equally likely (held-out seeds 201021, 201201, 202192).
  Fit with_effect(const Fit& base, const Effect& effect) const;

  /// `base` with one effect more, fitted without discrepancy.
  Fit with_effect_alone(const Fit& base, const Effect& effect) const;

  /// Residual at `at`, as Evaluation.
  Eigen::VectorXd residual(const Imperfections& at, LooseRow rest) const { return model_.said(at, rest).residual; }

  /// Contribution of an effect to the rows in use, rad.
  Eigen::VectorXd done_by(const Fit& fit, const Effect& effect) const;

  /// `fit` with the slopes of `effect` added at zero, and its evidence. No fit.
  Fit with_direction(const Fit& fit, const Effect& effect) const;

  /// `fit` with chords of `effect` over its expected sizes in place of slopes, without evidence.
  Fit with_chords(const Fit& fit, const Effect& effect) const;
  /// add_chords() for every start of the effect. Searched numbers are set to the start, and chords end there. Effects
  /// that begin at zero, or act otherwise when large, show in some starts only.
  std::vector<Fit> with_chords_of_starts(const Fit& fit, const Effect& effect) const;

 private:
  const Evidence& evidence() const { return model_.evidence(); }
  Fit placed(const EffectSet& effects, const Imperfections& at, LooseRow rest) const;
  Fit started(const EffectSet& effects, const Imperfections& at, LooseRow rest) const;
  Fit fitted(const EffectSet& effects, const Imperfections& from, LooseRow rest) const;
  /// Repeats the descent by the amplitudes found, as long as it predicts a gain.
  Fit settled(Fit fit) const;
  void take_slopes(Fit& fit, Eigen::Index from) const;
  Fit beside(const Fit& fit, const Effect& effect, const std::vector<double>& start) const;
  Fit beside(const Fit& fit, const Effect& effect) const;
  void take_chord(Fit& wider, Eigen::Index k, double size) const;
  Fit at(const Fit& base, const EffectSet& effects, const Imperfections& at) const;
  Fit descended(Fit fit, Eigen::Index from, int steps, const Amplitudes& amplitudes, int rounds) const;
  void hold_out_of(Fit& fit) const;
  void judge(Fit& fit) const;
  std::vector<Fit> started_beside(const Fit& base, const Effect& effect) const;
  double promised(const Fit& start, const Amplitudes& unnamed) const;
  /// Start with the largest predicted evidence beside a discrepancy of these amplitudes.
  struct Promise {
    std::size_t place = 0;
    double nats = 0;
  };
  Promise most_promising(const std::vector<Fit>& starts, const Amplitudes& unnamed) const;
  Fit by_chords(const Fit& base, const Fit& start, double promise) const;
  Fit named_first(const Fit& start) const;
  Amplitudes all_error_named(const Fit& fit) const;
  /// Evidence and held-out errors of a fit at the end of its steps.
  Fit judged(Fit fit) const;
  /// `fit`, or a likelier one from there whose loose rows rest at the last pushed position.
  Fit or_pushed(Fit fit) const;

  Model model_;
};

/// Linearization at the fit, rows in use.
Tangent tangent_of(const Evidence& evidence, const Fit& fit);
/// Moves a linearization to `x`.
Tangent said_of(Tangent tangent, const Eigen::VectorXd& x);

}  // namespace fusee
