/// \file
/// What each row in use stands for, in plain numbers: what anything without a name may depend on.
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/evidence.h"

namespace fusee {

struct RowFacts {
  double alpha = 0, theta = 0;  ///< as measured, rad
  double place = 0;             ///< 0 … 1 over the seen span of α
  double direction = 0;
  double since = 0;  ///< of the span, since the stroke began
  double load = 0;   ///< by the largest
  double speed = 0;  ///< of its run, by the largest
  double time = 0;   ///< within its run, −1 … 1
  /// What went on by then of all that the session has, each 0 … 1, or 0 throughout where there is none of it: time by
  /// the bench's clock, way of the motor there and back, load put on and off.
  double session = 0, way = 0, loading = 0;
  std::size_t run = 0;
  std::size_t block = 0;
};

/// Which of `count` even parts of the seen span a row lies in, from 0.
int place_bin(const RowFacts& row, int count);

/// Of the rows in use, block by block.
std::vector<RowFacts> row_facts(const Evidence& evidence);

/// Whether the rows differ in a number by more than `least`.
bool varies(const std::vector<RowFacts>& facts, double RowFacts::*number, double least);

}  // namespace fusee
