/// \file
/// The body without its cross features, as rings. mm, not yet scaled.
#pragma once

#include <vector>

#include "fusee/profile/outline.h"
#include "fusee/solid/layout.h"
#include "solid/rings.h"

namespace fusee {

/// The flanges' outlines, sampled at the outlines' normals.
struct FlangeRims {
  Polygon lip1;  ///< of groove P1
  Polygon lip2;
  Polygon lower;   ///< flange 1
  Polygon middle;  ///< strictly outside both lips
  Polygon upper;   ///< flange 2
};
FlangeRims flange_rims(const Outline& p1, const Outline& p2, double tendon_diameter, double groove_depth, Flange kind);

RingStack body_stack(const Outline& p1, const Outline& p2, double tendon_diameter, Flange kind,
                     const BodyLayout& layout);

/// The largest circle about the axis inside a convex polygon around it.
double inradius(const Polygon& convex);

}  // namespace fusee
