/// \file
/// Internal: both spirals on a common fan of normals, which gives the rows of the helical grid.
#pragma once

#include <cstddef>
#include <vector>

#include "fusee/base.h"
#include "fusee/coil.h"
#include "fusee/helix.h"

namespace fusee::coil {

/// A point on the pitch curve, in the part's frame.
struct WindingRow {
  Vec2 position = Vec2::Zero();
  Vec2 normal = Vec2::UnitX();
  double turn = 0;
  double rho = 0;
  double height = 0;
};

/// A spiral evaluated at any turn: cubic through the positions, tangents and radii of curvature of its rows.
class SpiralCurve {
 public:
  SpiralCurve(const helix::Spiral& spiral, const SpiralPlace& place) : spiral_(spiral), place_(place) {}

  double begin() const { return spiral_.rows.front().turn; }
  double end() const { return spiral_.rows.back().turn; }
  /// Extrapolates slightly beyond the ends.
  WindingRow at(double turn) const;
  /// The largest radius of curvature of all turns with this normal, within a turn's distance.
  double largest_rho(double turn) const;

 private:
  /// Two neighbouring rows, the turn between them, and the fraction of it at a place.
  struct Between {
    const helix::SpiralRow &a, &b;
    double step, u;

    double rho() const;
  };
  Between between(double turn) const;

  const helix::Spiral& spiral_;
  SpiralPlace place_;
};

/// The rows of one groove on the fan: row j has the normal of column (first_column + j) mod columns.
struct Winding {
  std::size_t first_column = 0;
  std::vector<WindingRow> rows;
  bool falls = false;  ///< height falls as the turn grows
  /// Numbers of rows at either end that continue the turn before, where the groove is filled up to its edges. They
  /// surround a channel that leaves the groove with solid.
  std::size_t filled_front = 0, filled_back = 0;

  /// Projection of the lower and upper groove edge of the first filled rows over the other rows, mm.
  double bulge_low = 0, bulge_high = 0;

  const WindingRow& groove_front() const { return rows[filled_front]; }
  const WindingRow& groove_back() const { return rows[rows.size() - 1 - filled_back]; }
  /// Fraction of the way from the groove's end (0) to the last filled row (1).
  double share_of_fill(std::size_t row) const {
    return row < filled_front
               ? static_cast<double>(filled_front - row) / static_cast<double>(filled_front)
               : static_cast<double>(row + filled_back + 1 - rows.size()) / static_cast<double>(filled_back);
  }
  bool is_filled(std::size_t row) const { return row < filled_front || row + filled_back >= rows.size(); }
};

/// The normals at which both grooves have rows, including the ends of both.
struct Fan {
  std::vector<double> angles;  ///< over one turn, in growing order
  Winding p1, p2;

  std::size_t columns() const { return angles.size(); }
};

/// Chords of any curve parallel to the pitch curves, up to `outward` of them, have a sagitta of at most `chord_error_mm`.
/// `filled`: least length of filled rows that follow P1's end and precede P2's beginning, mm. Rows lie outward of the
/// curve by a third of a chord's sagitta, so that the polygon is as long as the curve.
Fan make_fan(const SpiralCurve& p1, const SpiralCurve& p2, double outward, double floor_inward, double chord_error_mm,
             double filled);

}  // namespace fusee::coil
