/// \file
/// The simulated joint held against what was logged.
#pragma once

#include <Eigen/Dense>

#include "calibration/parameters.h"
#include "joint/forward.h"

namespace fusee {

/// Where the joint is taken to rest while nothing holds it.
enum class LooseRow {
  anywhere,  ///< about where it was last pushed, as far as its play goes: such a row says little
  pushed,    ///< just there: it says as much as any
};

/// What a model says of the logged angles, all runs one after another.
struct Said {
  Eigen::VectorXd residual;  ///< measured − model, rad; by its weight where the model's joint rests anywhere
  Eigen::VectorXd loose;     ///< that play, rad
};

/// For one thread. Evidence and simulation must outlive it.
class Model {
 public:
  Model(const Evidence& evidence, Forward& forward) : evidence_(evidence), forward_(forward) {}

  const Evidence& evidence() const { return evidence_; }
  /// Beside effects the free offset; of what changed since an earlier state the offset is an effect.
  Parameters varied(const EffectSet& effects) const {
    return evidence_.earlier ? parameters_of(effects) : fusee::varied(*evidence_.declared, effects);
  }
  Said said(const Imperfections& at, LooseRow rest) const;
  /// dθ/dx of one parameter by a step of its own size, away from its upper bound; `residual` is what is said at `at`.
  Eigen::VectorXd slope(const Imperfections& at, const EffectParameter& parameter, const Eigen::VectorXd& residual,
                        LooseRow rest) const;

 private:
  const Evidence& evidence_;
  Forward& forward_;
};

/// By how much the square of a loose row's residual is smaller than noise makes it, for its weight alone, rad²: where
/// nothing holds a joint it rests where it was last pushed, in friction, and a row there says little. So mean squares
/// are charged alike, whether a joint is loose or not.
double price_of_play(double loose, double floor);

/// What loose rows say beyond their weighted residuals: each rests where it was last pushed, and its whole residual
/// counts, or anywhere in the play; how many rest anywhere is what suits them best. So a joint is not made loose to be
/// rid of rows that nothing explains, nor of what noise leaves.
struct LooseRows {
  double nats = 0;          ///< to be taken off the evidence that half their weighted squares, in floors, give
  Eigen::VectorXd unheard;  ///< a row's square that says something of the fit's numbers, beyond the weighted one's: a
                            ///< factor; 0 where it is taut
};
LooseRows loose_rows(const Eigen::VectorXd& residual, const Eigen::VectorXd& loose, double floor);

/// rms over the rows in use, rad.
double rms_apart(const Evidence& evidence, const Eigen::VectorXd& one, const Eigen::VectorXd& other);

}  // namespace fusee
