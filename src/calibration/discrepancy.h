/// \file
/// What no effect has a name for, as far as it can be described: families of smooth functions of place, direction,
/// load, speed and time, each of one unknown amplitude.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "calibration/evidence.h"

namespace fusee {

/// On what a part of an error depends.
enum class Factor {
  place,            ///< α alone, whichever way, load and speed
  direction,        ///< odd in the direction of motion
  reversal,         ///< dies away over some way behind a reversal
  load,             ///< in proportion to the load
  load_size,        ///< with the size of the load, whichever its sign
  load_direction,   ///< a loop that grows with the load
  speed,            ///< in proportion to the speed, the same both ways
  speed_direction,  ///< a loop that grows with speed
  run,              ///< one constant a run
  drift,            ///< steadily in time within a run
  stroke,           ///< one constant a stroke
  model_error,      ///< what the model itself is not trusted to
};

/// Neighbouring columns with one amplitude: the rms of what they may add, over all rows.
struct Family {
  Factor factor = Factor::place;
  Eigen::Index first = 0;
  Eigen::Index count = 0;
  double fixed = 0;  ///< amplitude that is stated and not found, rad; 0: found
};

/// Columns over the rows in use, block by block: those of a family have a mean square of 1 over the rows in sum.
struct Discrepancy {
  Eigen::MatrixXd columns;
  std::vector<Family> families;
};

/// Of everything that these runs vary. `deflection`: of the declared joint, all rows, rad.
Discrepancy discrepancy_of(const Evidence& evidence, const Eigen::VectorXd& deflection);

}  // namespace fusee
