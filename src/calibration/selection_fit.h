/// \file
/// Fits of a set of effects to the data, and what they say of data that they did not see. Strokes are the sample, not rows.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "calibration/effects/effect.h"
#include "calibration/forward.h"

namespace fusee {

/// A stretch of rows that stands or falls together: a stroke.
struct Block {
  std::size_t run = 0;
  std::size_t stroke = 0;
  std::vector<std::size_t> rows;  ///< into the rows of all runs, one after another; without outliers
};

/// What is fitted to: thinned runs, and how they are cut into blocks and held out.
struct Evidence {
  const Mechanism* declared = nullptr;
  Measurement measurement;         ///< thinned
  Eigen::VectorXd theta;           ///< all runs, one after another
  std::vector<Block> blocks;
  std::vector<std::vector<std::size_t>> folds;  ///< blocks that are held out together
  std::vector<std::string> factors;             ///< by which whole levels are held out
  double floor = 0;                ///< rms noise, rad

  std::size_t rows_used() const;
};

Evidence gather(const Mechanism& declared, const Measurement& measurement, double floor);

using EffectSet = std::vector<const Effect*>;

/// Normal equations of one block, about the fitted parameters.
struct BlockSums {
  Eigen::MatrixXd JJ;
  Eigen::VectorXd Jr;
  double rr = 0;
  double rows = 0;
};

struct Fit {
  EffectSet effects;
  Imperfections at;
  Eigen::VectorXd x;              ///< the fitted members, each by its step
  Eigen::MatrixXd J;              ///< dθ/dx, rows of all runs
  Eigen::VectorXd residual;       ///< measured − model, rad
  std::vector<BlockSums> sums;
  std::vector<double> held_out;   ///< mean square error of each block, fitted without its fold, rad²
  double mean_square = 0;         ///< of the rows it was fitted to
  double held_out_mean_square = 0;
  bool usable = false;
};

/// The best of several starts. `from`: parameters known of effects that were fitted before.
Fit fit_effects(const Evidence& evidence, Forward& forward, const EffectSet& effects, const Imperfections& from);

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

struct Interval {
  double low = 0;
  double high = 0;
  double deviation = 0;
};
/// Of every fitted x, by resampling blocks.
std::vector<Interval> intervals(const Fit& fit);

/// The parameters that a fit varies, in the order of x.
std::vector<const EffectParameter*> varied(const Mechanism& declared, const EffectSet& effects);

}  // namespace fusee
