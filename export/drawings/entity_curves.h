/// \file
/// Internal: LINE, LWPOLYLINE, POLYLINE, CIRCLE, ARC, ELLIPSE and SPLINE as points in the drawing.
#pragma once

#include <optional>
#include <string>

#include "export/drawings/dxf_file.h"
#include "export/drawings/sampled_curves.h"

namespace fusee::formats {

/// Drawings with more points are rejected.
inline constexpr std::size_t k_most_points = 4'000'000;

/// An entity as a curve; without a curve, the entity is skipped.
struct EntityCurve {
  std::optional<SampledCurve> curve = std::nullopt;
  std::string skipped_kind = {};  ///< follows the type of a skipped entity in a list, such as " mesh"; may be empty
  std::string remark = {};        ///< about an accepted but unusual entity, or about a skipped one
};

/// `sagitta`: largest distance of chords from the curve, mm. Throws InputError for numbers that define no curve.
EntityCurve curve_of(const DxfEntity& entity, const std::string& file, const DrawingPlacement& place, double sagitta);

}  // namespace fusee::formats
