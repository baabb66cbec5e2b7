/// \file
/// Internal: the body without its cross features, as rings. mm, not yet scaled.
#pragma once

#include <vector>

#include "fusee/profile.h"
#include "fusee/solid.h"
#include "solid/rings.h"

namespace fusee::solid {

/// The flanges' outlines, sampled at the outlines' normals. If the outlines are so coarse that no rim of the same
/// normals lies outside both groove edges, `outside` is false and the rims must not be used.
struct FlangeRims {
  Polygon groove_edge1;  ///< edge of groove P1
  Polygon groove_edge2;
  Polygon lower;   ///< flange 1
  Polygon middle;  ///< strictly outside both groove edges
  /// The part of the middle flange that belongs to P2 when it is printed separately, strictly inside `middle`.
  Polygon under2;
  Polygon upper;  ///< flange 2
  bool outside = true;
};
FlangeRims flange_rims(const profile::Outline& p1, const profile::Outline& p2, double tendon_diameter,
                       double groove_depth, Flange kind);

/// Height of a cone from `inner` to `outer` (equal normals, one within the other) with no facet flatter than `slope`
/// above the horizontal.
double cone_height(const Polygon& inner, const Polygon& outer, double slope);

/// The whole body, or P1 or P2 only, at its position in the whole.
enum class Piece { whole, p1, p2 };
RingStack body_stack(const profile::Outline& p1, const profile::Outline& p2, double tendon_diameter, Flange kind,
                     const BodyLayout& layout, Piece piece = Piece::whole);

/// Radius of the largest circle about the axis inside a convex polygon around it.
double inradius(const Polygon& convex);

}  // namespace fusee::solid
