/// \file
/// Internal: the body as a stack of closed rings with vertical holes, its mesh, and its exact volume by the areas of
/// sections. mm.
#pragma once

#include <optional>
#include <vector>

#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::solid {

/// Convex, counter-clockwise, at one height. Point i of every ring of a stack has the same outward normal.
struct Ring {
  double z = 0;
  Polygon points;
};

/// A vertical hole, or the hub, of constant outline (counter-clockwise) from `low` to `high`.
struct Shaft {
  Polygon outline;
  double low = 0;
  double high = 0;
};

/// Consecutive rings are joined by strips. The lowest and the highest are capped. Two rings at the same height form a
/// flat step.
struct RingStack {
  std::vector<Ring> rings;
  std::optional<Shaft> hub;    ///< stands on the highest ring
  std::vector<Ring> recess;    ///< from the bottom face to its flat ceiling, or through the top; empty: none
  std::vector<Shaft> through;  ///< from the bottom, or from the recess's ceiling, up to the highest face
};

/// True if the recess ends in the highest face and not in a ceiling.
bool recess_goes_through(const RingStack& stack);
/// Multiplies every coordinate by `scale` and rounds it to float.
RingStack scaled_to_float(RingStack stack, double scale);
/// Keeps the stack's coordinates bit for bit. Neighbouring points that coincide become one vertex (far from the axis,
/// floats cannot resolve a finer curve).
TriangleMesh mesh_of(const RingStack& stack);
/// Exact volume of the stack's mesh. Between two rings the section's area is a quadratic in z, so Simpson's rule is
/// exact.
double volume_of(const RingStack& stack);

}  // namespace fusee::solid
