/// \file
/// Fits of a set of effects to the data, and what they say of data that they did not see. Strokes are the sample, not
/// rows.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "mechanism/effects/effect.h"
#include "calibration/evidence.h"

namespace fusee {

using EffectSet = std::vector<const Effect*>;

/// Normal equations of one block, about the fitted parameters.
struct BlockSums {
  Eigen::MatrixXd JJ;
  Eigen::VectorXd Jr;
  double rr = 0;
  double rows = 0;
};

/// Errors of data that were not fitted to.
struct HeldOut {
  std::vector<double>
      by_block;  ///< mean square error of each block, fitted without its fold, rad²; NaN where no fold holds it
  double mean_square = 0;
};

/// A fit, and what it says of data that it did not see.
struct Fit {
  EffectSet effects;
  Imperfections at;
  Eigen::VectorXd x;  ///< the fitted members, each by its step
  Eigen::MatrixXd J;  ///< dθ/dx, rows of all runs
  Eigen::VectorXd
      residual;           ///< measured − model, rad; zero where nothing holds the joint and it stands within its play
  Eigen::VectorXd loose;  ///< half that play, rad
  std::vector<BlockSums> sums;
  BlockSums readings;      ///< what was measured by hand, in the same unit
  HeldOut by_factor;       ///< Evidence::factor_folds: what decides
  HeldOut by_run;          ///< Evidence::run_folds: what is reported
  double mean_square = 0;  ///< of the rows it was fitted to, with `price`
  double price = 0;        ///< part of every mean square here: what the play of a loose joint must answer for, rad²
  double against_readings = 0;  ///< sum of squares of what was measured by hand, each by its uncertainty
  bool usable = false;
};

/// Held-out rms of the residual itself, by runs, rad.
inline double held_out_rms(const Fit& fit) { return std::sqrt(std::max(0.0, fit.by_run.mean_square - fit.price)); }

/// Robust, by Ceres, from where the members stand in `from`.
Fit fit_effects(const Evidence& evidence, Forward& forward, const EffectSet& effects, const Imperfections& from);

/// `base` with one effect more, from the best of its starts, close to its optimum: what candidates are compared by.
Fit with_effect(const Evidence& evidence, Forward& forward, const Fit& base, const Effect& effect);

/// `fit` with `effect` added where it does nothing: what the data would say of it. No fit.
Fit with_direction(const Evidence& evidence, Forward& forward, const Fit& fit, const Effect& effect);

/// How much lower the held-out error of `better` is: mean over the blocks, and standard error of that mean.
struct Comparison {
  double mean = 0;
  double standard_error = 0;
  double t = 0;
  double t_over_runs = 0;
  double needed_t = 0;  ///< one-sided 95 %
};
Comparison compare(const Evidence& evidence, const Fit& worse, const Fit& better);

/// Drop of the Bayesian information criterion with as many rows as the rest's autocorrelation leaves.
double bic_drop(const Evidence& evidence, const Fit& worse, const Fit& better);

/// Lag-1 autocorrelation of the residual within blocks.
double autocorrelation(const Evidence& evidence, const Fit& fit);

/// Of the residual: rms of the means of strokes about their run and direction, beyond what noise does to means, and rms
/// within strokes. rad
struct StrokeScatter {
  double between = 0;
  double within = 0;
};
StrokeScatter stroke_scatter(const Evidence& evidence, const Fit& fit);

struct Interval {
  double low = 0;
  double high = 0;
  double deviation = 0;
};
/// 95 % of every fitted x: by resampling strokes, or by the scatter between runs where that is wider.
std::vector<Interval> intervals(const Evidence& evidence, const Fit& fit);

/// The parameters that a fit varies, in the order of x.
std::vector<const EffectParameter*> varied(const Mechanism& declared, const EffectSet& effects);

}  // namespace fusee
