/// \file
/// Internal: outlines as circles and arcs, so that a drawing has few curves to select instead of hundreds of segments.
#pragma once

#include <optional>
#include <vector>

#include "export/drawings/sampled_curves.h"
#include "fusee/profile.h"
#include "fusee/solid.h"

namespace fusee::formats {

/// The circle about the axis through all of these points; empty if there is none.
std::optional<solid::RoundHole> circle_about_axis(const Polygon& points);

/// parallel(outline, distance) as a closed curve of tangent arcs: biarcs through some of its points, each as long as
/// possible within `tolerance` (mm) of the points between. Edges that no such arc can replace stay straight.
std::vector<BulgeVertex> fitted_arcs(const profile::Outline& outline, double distance, double tolerance);

}  // namespace fusee::formats
