/// \file
/// Bodies of a test model's parts: convex shapes, with holes, one above the other. mm.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/solid/mesh.h"

namespace fusee {

struct Disc {
  Vec2 centre{0, 0};
  double radius = 0;
};

/// The convex hull of discs: a circle of one, a slot of two, a rectangle with round corners of four.
struct DiscHull {
  std::vector<Disc> discs;
  int corners = 64;  ///< of its outline
};
DiscHull disc(const Vec2& centre, double radius);
DiscHull slot(const Vec2& from, const Vec2& to, double radius);
/// Corners are round by `radius`.
DiscHull box(const Vec2& low, const Vec2& high, double radius = 0.3);
/// Counter-clockwise; of a hull that is `grow` larger all round. Corner i has the same normal whatever `grow` is.
Polygon outline_of(const DiscHull& hull, double grow = 0);

/// One contour of a slab, upright where it grows by the same below and above.
struct SlabLoop {
  DiscHull hull;
  bool hole = false;
  double grow_low = 0;
  double grow_high = 0;
};
/// The loops of a slab do not touch. A loop that lies alike in the slab above goes on there; no other touches it.
struct Slab {
  double low = 0;
  double high = 0;
  std::vector<SlabLoop> loops;
};
/// Bottom to top, without a gap, as it lies on the printer: from z = 0.
struct SlabBody {
  std::vector<Slab> slabs;
};

/// What a print does to a part, taken back beforehand.
struct PrintTrim {
  double scale = 1;          ///< of all coordinates
  double hole = 0;           ///< added to the diameter of holes
  double elephant_foot = 0;  ///< chamfer at the bed
  double foot_slope = 1;     ///< height of that chamfer over its width
};
/// As it is to be printed: holes widened so that a polygon's sides touch the circle that is wanted.
SlabBody trimmed(const SlabBody& body, const PrintTrim& trim);
/// Its coordinates are floats already.
TriangleMesh mesh_of(const SlabBody& body, double scale = 1);
/// Exact, of that mesh before its coordinates are rounded. mm³
double volume_of(const SlabBody& body, double scale = 1);

}  // namespace fusee
