/// \file
/// Internal: places where a layer of a part can overhang the one below. mm.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::solid {

/// A set of places in plan, on a grid of cells over the part. "May meet" can be wrong, "does not meet" cannot.
class PlacesInPlan {
 public:
  PlacesInPlan(const Bounds& part, double reach);
  /// Adds all places within `reach` of the box.
  void add(const Vec2& low, const Vec2& high);
  bool none() const { return none_; }
  /// False if the line certainly meets no place.
  bool may_meet(const Vec2& from, const Vec2& to) const;

 private:
  static constexpr int k_cells = 64;  ///< cells along a side of the grid; the bits of a row
  int cell(double at, int axis) const;
  std::uint64_t columns(double from, double to) const;

  std::array<std::uint64_t, k_cells> rows_{};
  Vec2 low_, per_cell_;
  double reach_;
  bool none_ = true;
};

/// For each layer but the first, the places with a flat downward feature between the layer below and this one: a face
/// whose slope has a tangent below `steepness`, a ridge as flat, or a lowest point. Each is widened by the run of a
/// face of that slope between two layers. Any other point of a layer's outline is within that run of the layer below,
/// because the surface beneath it is steeper.
std::vector<PlacesInPlan> flat_downward_faces(const TriangleMesh& welded, const std::vector<double>& heights,
                                              double steepness);

}  // namespace fusee::solid
