/// \file
/// Fits of a set of effects, and their prediction of held-out rows. Strokes are the sample, not rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <stop_token>
#include <vector>

#include "calibration/evidence_model.h"
#include "calibration/held_out.h"
#include "calibration/model.h"

namespace fusee::calibration {

/// Fit of a set of effects, with its evidence and held-out errors.
struct Fit {
  EffectSet effects;
  Parameters parameters;  ///< parameters in the order of x
  Imperfections at;
  Eigen::VectorXd x;  ///< parameters, each divided by its step
  Eigen::MatrixXd J;  ///< dθ/dx at the rows of all runs
  LooseRow loose_row = LooseRow::anywhere;
  Eigen::VectorXd residual;  ///< residual as ModelResidual
  Eigen::VectorXd loose;
  std::vector<NormalEquations> sums;  ///< sums of each block
  NormalEquations readings;           ///< sums of caliper readings, in the same unit
  HeldOut by_factor;                  ///< held-out error by Evidence::factor_folds: decides
  HeldOut by_run;                     ///< held-out error by Evidence::run_folds: is reported
  double mean_square = 0;             ///< mean square of the fitted rows, with `play_square`
  double play_square = 0;             ///< part of every mean square that corrects for the play of a loose joint, rad²
  double caliper_chi2 = 0;            ///< χ² of the caliper readings
  Posterior posterior;                ///< posterior with the discrepancy marginalised
  double log_evidence = 0;            ///< log evidence of the set, loose rows corrected for; the larger is the likelier
  double discrepancy_penalty = 0;     ///< prior penalty of the remaining discrepancy, nats
  bool usable = false;
};

/// Held-out mean square of the residual, by runs, without the play correction, rad².
inline double held_out_square(const Fit& fit) { return std::max(0.0, fit.by_run.mean_square - fit.play_square); }
/// Root of held_out_square(), rad.
inline double held_out_rms(const Fit& fit) { return std::sqrt(held_out_square(fit)); }

/// Fixes each parameter that is at a bound, in every subset of the data: its slopes become 0.
void hold_at_bounds(Fit& fit);

/// Indices of an effect's parameters in the fit.
std::vector<Eigen::Index> places_of(const Fit& fit, const fusee::Effect& effect);
/// Contribution of a fitted effect to the angles of the rows in use, rad.
Eigen::VectorXd contribution(const Evidence& evidence, const Fit& fit, const fusee::Effect& effect);

/// The numbers `at` with those of the effect settled (Effect::settle). The numbers of a difference between two states
/// stay as they are: they are no joint.
Imperfections settled(const Evidence& evidence, const fusee::Effect& effect, Imperfections at);

/// Fits the joint to the evidence, the discrepancy marginalised. For one thread.
class Fitter {
 public:
  Fitter(const Evidence& evidence, joint::Forward& forward) : model_(evidence, forward) {}

  /// Full fit from the parameters of `from`.
  Fit fit(const EffectSet& effects, const Imperfections& from) const;

  /// Least-squares fit of the same set from there, as hold_out() fits: no prior sizes, no discrepancy.
  Fit fit_least_squares(const Fit& fit) const;

  /// `base` with one effect more, from the best of its starts, close to the optimum: for the comparison of candidates.
  /// Fitted from the likeliest start beside the discrepancy, and from the likeliest start without discrepancy. If the
  /// discrepancy explains everything, all starts beside it are equally likely (held-out seeds 201021, 201201, 202192).
  Fit add_effect(const Fit& base, const fusee::Effect& effect) const;

  /// `base` with one effect more, fitted without discrepancy.
  Fit add_effect_without_discrepancy(const Fit& base, const fusee::Effect& effect) const;

  /// Residual at `at`, as ModelResidual.
  Eigen::VectorXd residual(const Imperfections& at, LooseRow loose_row) const {
    return model_.evaluate(at, loose_row).residual;
  }

  /// Contribution of an effect to the rows in use, rad.
  Eigen::VectorXd contribution_of(const Fit& fit, const fusee::Effect& effect) const;

  /// `fit` with the slopes of `effect` added at zero, and its evidence. No fit.
  Fit add_slopes(const Fit& fit, const fusee::Effect& effect) const;

  /// `fit` with chords of `effect` over its expected sizes in place of slopes, without evidence.
  Fit add_chords(const Fit& fit, const fusee::Effect& effect) const;
  /// add_chords() for every start of the effect. Searched numbers are set to the start, and chords end there. Effects
  /// that begin at zero, or act otherwise when large, show in some starts only.
  std::vector<Fit> add_chords_of_starts(const Fit& fit, const fusee::Effect& effect) const;

 private:
  const Evidence& evidence() const { return model_.evidence(); }
  Fit evaluate_at(const EffectSet& effects, const Imperfections& at, LooseRow loose_row) const;
  Fit linearize_at(const EffectSet& effects, const Imperfections& at, LooseRow loose_row) const;
  Fit descend_fully(const EffectSet& effects, const Imperfections& from, LooseRow loose_row) const;
  /// Repeats the descent by the amplitudes found, as long as it predicts a gain.
  Fit refine(Fit fit) const;
  void take_slopes(Fit& fit, Eigen::Index from) const;
  Fit extend(const Fit& fit, const fusee::Effect& effect, const std::vector<double>& start) const;
  Fit extend(const Fit& fit, const fusee::Effect& effect) const;
  void take_chord(Fit& wider, Eigen::Index k, double size) const;
  Fit at(const Fit& base, const EffectSet& effects, const Imperfections& at) const;
  Fit descend(Fit fit, Eigen::Index from, int steps, const Amplitudes& amplitudes, int rounds) const;
  void hold_out_of(Fit& fit) const;
  void compute_evidence(Fit& fit) const;
  std::vector<Fit> linearize_starts(const Fit& base, const fusee::Effect& effect) const;
  double predict_evidence(const Fit& start, const Amplitudes& amplitudes) const;
  /// Start with the largest predicted evidence beside a discrepancy of these amplitudes.
  struct PredictedStart {
    std::size_t place = 0;
    double nats = 0;
  };
  PredictedStart select_start(const std::vector<Fit>& starts, const Amplitudes& amplitudes) const;
  Fit fit_by_chords(const Fit& base, const Fit& start, double predicted_evidence) const;
  Fit fit_effects_first(const Fit& start) const;
  Amplitudes amplitudes_without_discrepancy(const Fit& fit) const;
  /// Evidence and held-out errors of a fit at the end of its steps.
  Fit with_evidence(Fit fit) const;
  /// `fit`, or a likelier one from there whose loose rows rest at the last pushed position.
  Fit prefer_pushed(Fit fit) const;

  Model model_;
};

/// `fit` with its parameters as constants: a discrepancy beside it describes the residual alone.
Fit with_fixed_parameters(const Evidence& evidence, Fit fit);

/// Linearization at the fit, rows in use.
Tangent tangent_of(const Evidence& evidence, const Fit& fit);
/// Moves a linearization to `x`.
Tangent move_tangent(Tangent tangent, const Eigen::VectorXd& x);

class FitterPool {
 public:
  /// `evidence` must outlive this.
  explicit FitterPool(const Evidence& evidence, std::stop_token stop = {});

  /// Calls `job` for 0 … count − 1, with one simulation for each thread. Rethrows the exception of the lowest index.
  /// Throws Stopped after a request to stop. `done(n)` is called from the calling thread when n jobs have ended;
  /// it may throw.
  void each(std::size_t count, const std::function<void(const Fitter&, std::size_t)>& job,
            const std::function<void(std::size_t)>& done = {});
  /// Fitter for a single fit between jobs.
  Fitter one() { return Fitter(evidence_, forwards_.front()); }

 private:
  const Evidence& evidence_;
  std::stop_token stop_;
  std::vector<joint::Forward> forwards_;
};

}  // namespace fusee::calibration
