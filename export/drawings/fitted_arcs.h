/// \file
/// Outlines as circles and arcs, so that a drawing has a few curves to select in place of hundreds of straight pieces.
#pragma once

#include <optional>
#include <vector>

#include "export/drawings/sampled_curves.h"
#include "fusee/profile/outline.h"
#include "fusee/solid/layout.h"

namespace fusee {

/// The circle about the axis that all of these points lie on; nothing where they lie on none.
std::optional<RoundHole> circle_about_axis(const Polygon& points);

/// parallel(outline, distance) as arcs with common tangents: biarcs through some of its points, each as long as it
/// stays within `tolerance` (mm) of the points between. An edge without such arcs stays straight. Closed.
std::vector<BulgeVertex> fitted_arcs(const Outline& outline, double distance, double tolerance);

}  // namespace fusee
