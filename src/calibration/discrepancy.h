/// \file
/// Model discrepancy: families of smooth functions of place, direction, load, speed and time. Each family has one
/// unknown amplitude.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "calibration/evidence.h"

namespace fusee::calibration {

/// Factor that a component of the discrepancy depends on.
enum class Factor {
  place,            ///< α alone, at any direction, load and speed
  direction,        ///< odd in the direction of motion
  reversal,         ///< decays with the distance since a reversal
  load,             ///< in proportion to the load
  load_size,        ///< with the size of the load, whichever its sign
  load_direction,   ///< hysteresis that grows with the load
  speed,            ///< in proportion to the speed, the same both ways
  speed_direction,  ///< hysteresis that grows with speed
  run,              ///< one constant per run
  drift,            ///< steadily in time within a run
  stroke,           ///< one constant per stroke
  model_error,      ///< error of the model itself
};

/// Neighbouring columns with a common amplitude, which is the rms of their sum over all rows.
struct Family {
  Factor factor = Factor::place;
  Eigen::Index first = 0;
  Eigen::Index count = 0;
  double fixed = 0;  ///< fixed amplitude, rad; 0: estimated
};

/// Columns over the rows in use, block by block. The mean squares of a family's columns sum to 1 over the rows.
struct Discrepancy {
  Eigen::MatrixXd columns;
  std::vector<Family> families;
};

/// Sum over the families whose factor `is_in` accepts, for the rows in use. `coefficients`: one for each column.
Eigen::VectorXd sum_of_families(const Discrepancy& discrepancy, const Eigen::VectorXd& coefficients,
                                const std::function<bool(Factor)>& is_in);

/// Families of all factors that these runs vary. `deflection`: of the declared joint, all rows, rad.
Discrepancy discrepancy_of(const Evidence& evidence, const Eigen::VectorXd& deflection);

}  // namespace fusee::calibration
