/// \file
/// Bodies of a test rig's parts: stacks of slabs with convex outlines and holes. mm.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/solid/mesh.h"

namespace fusee {

struct Disc {
  Vec2 centre{0, 0};
  double radius = 0;
};

/// The convex hull of discs: one disc gives a circle, two a slot, four a rectangle with round corners.
struct DiscHull {
  std::vector<Disc> discs;
  int corners = 64;  ///< number of corners of its outline
};
DiscHull disc(const Vec2& centre, double radius);
DiscHull slot(const Vec2& from, const Vec2& to, double radius);
/// A rectangle whose corners have the radius `radius`.
DiscHull box(const Vec2& low, const Vec2& high, double radius = 0.3);
/// Counter-clockwise outline of the hull, enlarged by `grow` all round. Corner i has the same normal for every `grow`.
Polygon outline_of(const DiscHull& hull, double grow = 0);

/// One contour of a slab, vertical if both growths are equal.
struct SlabLoop {
  DiscHull hull;
  bool hole = false;
  double grow_low = 0;
  double grow_high = 0;
};
/// The loops of a slab must not touch. An identical loop in the slab above continues it; no other may touch it.
struct Slab {
  double low = 0;
  double high = 0;
  std::vector<SlabLoop> loops;
};
/// Slabs from bottom to top without gaps, in print orientation from z = 0.
struct SlabBody {
  std::vector<Slab> slabs;
};

/// Compensation for the effects of printing.
struct PrintTrim {
  double scale = 1;          ///< of all coordinates
  double hole = 0;           ///< added to the diameter of holes
  double elephant_foot = 0;  ///< chamfer at the bed
  double foot_slope = 1;     ///< height of that chamfer over its width
};
/// The body as it is printed: holes are widened so that a polygon's sides touch the nominal circle.
SlabBody trimmed(const SlabBody& body, const PrintTrim& trim);
/// The mesh with coordinates rounded to float.
TriangleMesh mesh_of(const SlabBody& body, double scale = 1);
/// Exact volume of that mesh before rounding. mm³
double volume_of(const SlabBody& body, double scale = 1);

}  // namespace fusee
