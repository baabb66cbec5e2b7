/// \file
/// The body without its cross features, as rings. mm, not yet scaled.
#pragma once

#include <vector>

#include "fusee/profile/outline.h"
#include "fusee/solid/layout.h"
#include "solid/rings.h"

namespace fusee {

/// The flanges' outlines, sampled at the outlines' normals. Where these are so coarse that no rim of the same normals
/// lies outside both lips, `outside` is false, and nothing is made of them.
struct FlangeRims {
  Polygon lip1;  ///< of groove P1
  Polygon lip2;
  Polygon lower;   ///< flange 1
  Polygon middle;  ///< strictly outside both lips
  Polygon under2;  ///< P2's own share of the middle flange where it is printed for itself, strictly inside `middle`
  Polygon upper;   ///< flange 2
  bool outside = true;
};
FlangeRims flange_rims(const Outline& p1, const Outline& p2, double tendon_diameter, double groove_depth, Flange kind);

/// Height of a cone from `inner` to `outer` (equal normals, one within the other) none of whose facets is flatter than
/// `slope` above the horizontal.
double cone_height(const Polygon& inner, const Polygon& outer, double slope);

/// Both pulleys as one, P1 alone or P2 alone, all where they stand in the whole.
enum class Piece { whole, p1, p2 };
RingStack body_stack(const Outline& p1, const Outline& p2, double tendon_diameter, Flange kind,
                     const BodyLayout& layout, Piece piece = Piece::whole);

/// The largest circle about the axis inside a convex polygon around it.
double inradius(const Polygon& convex);

}  // namespace fusee
