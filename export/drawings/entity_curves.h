/// \file
/// LINE, LWPOLYLINE, POLYLINE, CIRCLE, ARC, ELLIPSE and SPLINE as points in their place in the drawing.
#pragma once

#include <optional>
#include <string>

#include "export/drawings/dxf_file.h"
#include "export/drawings/sampled_curves.h"

namespace fusee {

/// A drawing of more points than this is refused.
inline constexpr std::size_t k_most_points = 4'000'000;

/// The curve; without one, what kind of it is passed over (" mesh"; "" where the entity is no line at all).
struct EntityCurve {
  std::optional<SampledCurve> curve = std::nullopt;
  std::string passed_over = {};
  std::string remark = {};  ///< on an odd entity that was understood all the same
};

/// `sagitta`: how far chords may lie from the curve, mm. Throws InputError for numbers that make no curve.
EntityCurve curve_of(const DxfEntity& entity, const std::string& file, const DrawingPlacement& place, double sagitta);

}  // namespace fusee
