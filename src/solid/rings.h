/// \file
/// The body as a stack of closed rings with vertical holes: its mesh and, by the areas of sections, its exact volume.
/// mm.
#pragma once

#include <optional>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// Convex, counter-clockwise, at one height. Point i of every ring of a stack has the same outward normal.
struct Ring {
  double z = 0;
  Polygon points;
};

/// A vertical hole of constant outline (counter-clockwise) from `low` to `high`.
struct Shaft {
  Polygon outline;
  double low = 0;
  double high = 0;
};

/// Consecutive rings are joined by strips; the lowest and the highest are capped. Rings at the same height make a flat
/// step.
struct RingStack {
  std::vector<Ring> rings;
  std::optional<Shaft> hub;  ///< stands on the highest ring
  std::vector<Ring> recess;  ///< from its mouth in the bottom face to its flat ceiling, or through the top; empty: none
  std::vector<Shaft> through;  ///< up to the top of all, from the bottom or, within the recess, from its ceiling
};

/// Does the recess end in the top of all, and not in a ceiling?
bool recess_goes_through(const RingStack& stack);
/// Every coordinate times `scale`, rounded to float.
RingStack scaled_to_float(RingStack stack, double scale);
/// The stack's coordinates are kept to the bit. Neighbouring points that are one (far from the axis floats hold no
/// finer curve) are one vertex.
TriangleMesh mesh_of(const RingStack& stack);
/// Exact volume of that mesh: between two rings the section's area is a quadratic in z, so Simpson's rule has no error.
double volume_of(const RingStack& stack);

}  // namespace fusee
