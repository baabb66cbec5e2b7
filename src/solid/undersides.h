/// \file
/// Where a layer of a part may stand out over the one below at all. mm.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// Places in plan, kept by the cells of a grid over the part: "no" is sure.
class PlacesInPlan {
 public:
  PlacesInPlan(const Bounds& part, double reach);
  /// All within `reach` of the box.
  void add(const Vec2& low, const Vec2& high);
  bool none() const { return none_; }
  bool may_meet(const Vec2& from, const Vec2& to) const;

 private:
  static constexpr int k_cells = 64;  ///< a side of the grid; the bits of a row
  int cell(double at, int axis) const;
  std::uint64_t columns(double from, double to) const;

  std::array<std::uint64_t, k_cells> rows_{};
  Vec2 low_, per_cell_;
  double reach_;
  bool none_ = true;
};

/// Of each layer but the first: where, within the height from the layer below up to this one, the welded mesh has a
/// face that looks down at a slope of less than `steepness` (its tangent), a keel as flat, or a lowest point; each
/// widened by how far a face of that slope leads between two layers. From any other point of a layer's outline one
/// comes down to the layer below within that distance: straight down through the part, then down its surface, where it
/// is steepest.
std::vector<PlacesInPlan> flat_undersides(const TriangleMesh& welded, const std::vector<double>& heights,
                                          double steepness);

}  // namespace fusee
