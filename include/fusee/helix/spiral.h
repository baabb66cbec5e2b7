/// \file
/// The pitch curve of a helical groove: the tendon's centre line over several turns.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace fusee {

/// One row of the pitch curve of a helical groove.
struct SpiralRow {
  double x = 0, y = 0;  ///< mm, on the pitch curve (tendon's centre line in plan), pulley frame at home
  double turn = 0;      ///< rad, angle of the outward normal, unrolled over all turns, monotone
  double rho = 0;       ///< mm, radius of curvature in plan, > 0
  double s = 0;         ///< mm, planar arc length from the first row
  double z = 0;         ///< mm, height of the tendon's centre line: linear in s
};

/// The outward normal at a row is (cos turn, sin turn). From one turn to the next, z grows by at least the groove's
/// width, a rib and the step between both radii.
struct Spiral {
  std::vector<SpiralRow> rows;                ///< in growing `turn`, spare turns at both ends included
  double slope = 0;                           ///< tan λ = dz/ds
  std::size_t first_used = 0, last_used = 0;  ///< rows of the working arc, without the spare turns

  /// The row nearest to a height.
  const SpiralRow& row_at(double z) const {
    return *std::min_element(rows.begin(), rows.end(), [z](const SpiralRow& a, const SpiralRow& b) {
      return std::abs(a.z - z) < std::abs(b.z - z);
    });
  }
};

}  // namespace fusee
