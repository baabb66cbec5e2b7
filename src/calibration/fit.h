/// \file
/// Fits of a set of effects to the data, and what they say of data that they did not see. Strokes are the sample, not
/// rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibration/held_out.h"
#include "calibration/marginal.h"
#include "calibration/model.h"
#include "calibration/normal_equations.h"

namespace fusee {

/// A fit, and what it says of data that it did not see.
struct Fit {
  EffectSet effects;
  Parameters parameters;  ///< in the order of x
  Imperfections at;
  Eigen::VectorXd x;  ///< the parameters, each by its step
  Eigen::MatrixXd J;  ///< dθ/dx, rows of all runs
  LooseRow rest = LooseRow::anywhere;
  Eigen::VectorXd residual;  ///< as Said
  Eigen::VectorXd loose;
  std::vector<NormalEquations> sums;  ///< block by block
  NormalEquations readings;           ///< what was measured by hand, in the same unit
  HeldOut by_factor;                  ///< Evidence::factor_folds: what decides
  HeldOut by_run;                     ///< Evidence::run_folds: what is reported
  double mean_square = 0;             ///< of the rows it was fitted to, with `price`
  double price = 0;  ///< part of every mean square here: what the play of a loose joint must answer for, rad²
  double against_readings = 0;  ///< sum of squares of what was measured by hand, each by its uncertainty
  Explained explained;          ///< what the data say there, discrepancy beside it
  double log_evidence = 0;      ///< of the set, with the price of play; of two sets the larger is the likelier
  double rareness_of_rest = 0;  ///< nats: of what stays without a name beside it
  bool usable = false;
};

/// Held-out mean square of the residual itself, by runs, rad².
inline double held_out_square(const Fit& fit) { return std::max(0.0, fit.by_run.mean_square - fit.price); }
/// Its root, rad.
inline double held_out_rms(const Fit& fit) { return std::sqrt(held_out_square(fit)); }

/// At its bound a parameter stays there, whatever part of the data it is fitted to: its slopes become nothing.
void hold_at_bounds(Fit& fit);

/// Of an effect's numbers among the fit's.
std::vector<Eigen::Index> places_of(const Fit& fit, const Effect& effect);

/// Fits the joint to the evidence, the discrepancy beside it. For one thread.
class Fitter {
 public:
  Fitter(const Evidence& evidence, Forward& forward) : model_(evidence, forward) {}

  /// To the end, from where the parameters stand in `from`.
  Fit fit(const EffectSet& effects, const Imperfections& from) const;

  /// The same set from there to the least squares, as hold_out() fits: no sizes in practice, nothing without a name.
  Fit by_squares(const Fit& fit) const;

  /// `base` with one effect more, from the best of its starts, close to its optimum: what candidates are compared by.
  /// The best beside what has no name, and, with all slopes, the best as if all that is left were named: the former
  /// explains as much at any start where it takes all (unopened split, seeds 201021, 201201, 202192).
  Fit with_effect(const Fit& base, const Effect& effect) const;

  /// The same as if all that is left were the effect's.
  Fit with_effect_alone(const Fit& base, const Effect& effect) const;

  /// What `at` leaves of the readings, as Said.
  Eigen::VectorXd residual(const Imperfections& at, LooseRow rest) const { return model_.said(at, rest).residual; }

  /// What an effect of `fit` does to the rows in use, rad.
  Eigen::VectorXd done_by(const Fit& fit, const Effect& effect) const;

  /// `fit` with `effect` added where it does nothing: what the data would say of it. No fit.
  Fit with_direction(const Fit& fit, const Effect& effect) const;

  /// The same with chords in place of slopes: each number's over its size in practice. Not weighed.
  Fit with_chords(const Fit& fit, const Effect& effect) const;
  /// The same once for every start of the effect: with what is searched as it begins there, and each number's chord to
  /// where it does. What begins at nothing, or acts otherwise when it is large, shows itself in some of them alone.
  std::vector<Fit> with_chords_of_starts(const Fit& fit, const Effect& effect) const;

 private:
  const Evidence& evidence() const { return model_.evidence(); }
  Fit placed(const EffectSet& effects, const Imperfections& at, LooseRow rest) const;
  Fit started(const EffectSet& effects, const Imperfections& at, LooseRow rest) const;
  Fit fitted(const EffectSet& effects, const Imperfections& from, LooseRow rest) const;
  /// Steps from a place that was judged, by the amplitudes there, as long as they promise something.
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
  /// Of the start whose slopes promise most with so much unnamed beside them.
  struct Promise {
    std::size_t place = 0;
    double nats = 0;
  };
  Promise most_promising(const std::vector<Fit>& starts, const Amplitudes& unnamed) const;
  Fit by_chords(const Fit& base, const Fit& start, double promise) const;
  Fit named_first(const Fit& start) const;
  Amplitudes all_error_named(const Fit& fit) const;
  /// At the end of its steps.
  Fit judged(Fit fit) const;
  /// `fit`, or a likelier one from there whose loose rows rest just where the joint was last pushed.
  Fit or_pushed(Fit fit) const;

  Model model_;
};

/// What a set's evidence is computed from: the rows in use.
Tangent tangent_of(const Evidence& evidence, const Fit& fit);
/// What a tangent says of the place `x`.
Tangent said_of(Tangent tangent, const Eigen::VectorXd& x);

}  // namespace fusee
