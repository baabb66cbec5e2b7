/// \file
/// Residuals and slopes of the simulated joint.
#pragma once

#include <Eigen/Dense>

#include "calibration/parameters.h"
#include "joint/forward.h"

namespace fusee::calibration {

/// Rest position of a joint that is loose within its play.
enum class LooseRow {
  anywhere,  ///< anywhere within the play about the last pushed position: such a row carries little information
  pushed,    ///< at the last pushed position: such a row carries full information
};

/// Residual of the model over all runs, one after another.
struct ModelResidual {
  Eigen::VectorXd residual;  ///< measured − model, rad; weighted where the joint is loose and rests anywhere
  Eigen::VectorXd loose;     ///< play at each row, rad
};

/// Used by one thread. Evidence and simulation must outlive it.
class Model {
 public:
  Model(const Evidence& evidence, joint::Forward& forward) : evidence_(evidence), forward_(forward) {}

  const Evidence& evidence() const { return evidence_; }
  /// Varied numbers: the free offset, then those of the effects. With an earlier state the offset is itself an effect.
  Parameters varied(const EffectSet& effects) const {
    return evidence_.earlier ? parameters_of(effects) : fusee::calibration::varied(*evidence_.declared, effects);
  }
  ModelResidual evaluate(const Imperfections& at, LooseRow loose_row) const;
  /// dθ/dx of one parameter by a step of its own size, away from its upper bound; `residual` is that at `at`.
  Eigen::VectorXd slope(const Imperfections& at, const EffectParameter& parameter, const Eigen::VectorXd& residual,
                        LooseRow loose_row) const;

 private:
  const Evidence& evidence_;
  joint::Forward& forward_;
};

/// Correction of the square of a loose row's residual, rad²: floor² (1 − w²) for weight w. Makes mean squares of loose
/// and taut joints comparable.
double play_correction(double loose, double floor);

/// Likelihood of loose rows: a mixture of rest at the last pushed position (full residual) and rest anywhere in the
/// play (weighted residual), its share fitted by expectation maximisation. Without it a joint would be made loose to
/// discount rows that nothing explains.
struct LooseRows {
  double nats = 0;  ///< evidence that the mixture loses against half the weighted squares in floors
  /// information of each row beyond that of the weighted one, as a factor; 0 for a taut row
  Eigen::VectorXd extra_information;
};
LooseRows loose_rows(const Eigen::VectorXd& residual, const Eigen::VectorXd& loose, double floor);

/// rms difference over the rows in use, rad.
double rms_apart(const Evidence& evidence, const Eigen::VectorXd& one, const Eigen::VectorXd& other);

}  // namespace fusee::calibration
