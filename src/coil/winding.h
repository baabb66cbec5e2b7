/// \file
/// Spirals on a common fan of normals: the rows of the helical grid.
#pragma once

#include <cstddef>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/coil/helical_pulley.h"
#include "fusee/helix/spiral.h"

namespace fusee {

/// A place on the pitch curve, in the part's frame.
struct WindingRow {
  Vec2 position = Vec2::Zero();
  Vec2 normal = Vec2::UnitX();
  double turn = 0;
  double rho = 0;
  double height = 0;
};

/// A spiral at any turn: cubic through its rows' places, tangents and radii of curvature.
class SpiralCurve {
 public:
  SpiralCurve(const Spiral& spiral, const SpiralPlace& place) : spiral_(spiral), place_(place) {}

  double begin() const { return spiral_.rows.front().turn; }
  double end() const { return spiral_.rows.back().turn; }
  /// A little beyond the ends is extrapolated.
  WindingRow at(double turn) const;
  /// The largest radius of curvature within a turn's distance, of all turns with this normal.
  double largest_rho(double turn) const;

 private:
  /// Two neighbouring rows, the turn from one to the other, and the share of it that is gone.
  struct Between {
    const SpiralRow &a, &b;
    double step, u;

    double rho() const;
  };
  Between between(double turn) const;

  const Spiral& spiral_;
  SpiralPlace place_;
};

/// One groove's rows on the fan: row j has the normal of column (first_column + j) mod columns.
struct Winding {
  std::size_t first_column = 0;
  std::vector<WindingRow> rows;
  bool falls = false;  ///< as the turn grows
  /// Rows at either end that go on as the turn before did, in which the groove is filled up to its lips: a channel that
  /// leaves the groove has solid about it.
  std::size_t filled_front = 0, filled_back = 0;

  /// How far the lower and the upper lip of the first filled rows stand out over the others, mm.
  double bulge_low = 0, bulge_high = 0;

  const WindingRow& groove_front() const { return rows[filled_front]; }
  const WindingRow& groove_back() const { return rows[rows.size() - 1 - filled_back]; }
  /// 0 … 1 from the groove's end to the last filled row.
  double share_of_fill(std::size_t row) const {
    return row < filled_front
               ? static_cast<double>(filled_front - row) / static_cast<double>(filled_front)
               : static_cast<double>(row + filled_back + 1 - rows.size()) / static_cast<double>(filled_back);
  }
  bool is_filled(std::size_t row) const { return row < filled_front || row + filled_back >= rows.size(); }
};

/// Normals that both grooves have rows at, the ends of both among them.
struct Fan {
  std::vector<double> angles;  ///< over one turn, growing
  Winding p1, p2;

  std::size_t columns() const { return angles.size(); }
};

/// No chord of a curve parallel to the pitch curves, up to `outward` of them, has a sagitta larger than `tolerance`.
/// `filled`: how far P1's end and P2's beginning are followed by filled rows, at least, mm.
/// Rows stand outward of the curve by a third of a chord's sagitta: the polygon is then as long as the curve is.
Fan make_fan(const SpiralCurve& p1, const SpiralCurve& p2, double outward, double floor_inward, double tolerance,
             double filled);

}  // namespace fusee
