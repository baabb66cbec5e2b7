/// \file
/// Internal: samples both spirals at common normals (the fan). The samples are the rows of the helical grid.
#pragma once

#include <cstddef>
#include <vector>

#include "fusee/base.h"
#include "fusee/helical_solid.h"
#include "fusee/helix.h"

namespace fusee::helical_solid {

/// A point on the pitch curve, in the part's frame. mm
struct WindingRow {
  Vec2 position = Vec2::Zero();
  Vec2 normal = Vec2::UnitX();
  double turn = 0;    ///< direction of the normal, counted over all turns, rad
  double rho = 0;     ///< radius of curvature
  double height = 0;  ///< above the lower face
};

/// A spiral evaluated at any turn: cubic Hermite interpolation of the positions and tangents of its rows.
class SpiralCurve {
 public:
  SpiralCurve(const helix::Spiral& spiral, const SpiralPlace& place) : spiral_(spiral), place_(place) {}

  double begin() const { return spiral_.rows.front().turn; }
  double end() const { return spiral_.rows.back().turn; }
  /// Extrapolates slightly beyond the ends.
  WindingRow at(double turn) const;
  /// The largest radius of curvature at the points with this normal, one on each turn of the spiral.
  double largest_rho(double turn) const;

 private:
  /// A place between two neighbouring rows: the turn from `a` to `b`, and the fraction of it from `a` to the place.
  struct PlaceBetweenRows {
    const helix::SpiralRow &a, &b;
    double step, u;

    double rho() const;
  };
  PlaceBetweenRows between(double turn) const;

  const helix::Spiral& spiral_;
  SpiralPlace place_;
};

/// The rows of one groove: row j has the normal of the fan's column (first_column + j) mod columns.
struct Winding {
  std::size_t first_column = 0;
  std::vector<WindingRow> rows;
  bool falls = false;  ///< height falls as the turn grows
  /// Numbers of rows added at either end. They repeat the adjacent turn, with the groove filled up to its edges, so
  /// that the channel that leaves the groove there is enclosed by solid.
  std::size_t filled_front = 0, filled_back = 0;

  /// Distance by which the lower and the upper groove edge of the first filled rows project beyond other rows, mm.
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

/// The normals at which both grooves have rows. The ends of both grooves are among them.
struct Fan {
  std::vector<double> angles;  ///< over one turn, in growing order
  Winding p1, p2;

  std::size_t columns() const { return angles.size(); }
};

/// Chooses columns such that the chords of any curve parallel to a pitch curve, up to `outward` outside it, have a
/// sagitta of at most `chord_error_mm`. Rows are moved outward by a third of the sagitta, so that the polygon of the
/// floor, `floor_inward` inside the pitch curve, is as long as its curve. `filled`: least length of the filled rows
/// after P1's end and before P2's beginning. mm.
Fan make_fan(const SpiralCurve& p1, const SpiralCurve& p2, double outward, double floor_inward, double chord_error_mm,
             double filled);

}  // namespace fusee::helical_solid
