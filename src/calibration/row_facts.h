/// \file
/// Properties of each row in use, on which a discrepancy may depend.
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/evidence.h"

namespace fusee::calibration {

struct RowFacts {
  double alpha = 0, theta = 0;  ///< measured angles, rad
  double place = 0;             ///< 0 … 1 over the measured range of α
  double direction = 0;
  double since = 0;  ///< travel since the stroke began, as a share of the range
  double load = 0;   ///< load / largest load
  double speed = 0;  ///< speed of its run / largest speed
  double time = 0;   ///< time within its run, −1 … 1
  /// Shares of the session's totals up to this row, 0 … 1 (all 0 if the total is 0): time by the bench's clock, travel
  /// of the motor, and load changes.
  double session = 0, way = 0, loading = 0;
  std::size_t run = 0;
  std::size_t block = 0;
};

/// Index of the bin of a row among `count` equal parts of the measured range.
int place_bin(const RowFacts& row, int count);

/// Properties of the rows in use, block by block.
std::vector<RowFacts> row_facts(const Evidence& evidence);

/// True if a property varies over the rows by more than `least`.
bool varies(const std::vector<RowFacts>& facts, double RowFacts::*number, double least);

}  // namespace fusee::calibration
