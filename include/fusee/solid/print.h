/// \file
/// Does a part print as it lies, without supports? Measured on the mesh that was written, not on what was meant.
#pragma once

#include <vector>

#include "fusee/base/check.h"
#include "fusee/base/units.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// What a desktop printer bears, rad and mm; the reasons stand in check_print.cpp.
struct PrintLimits {
  /// Flattest slope above the horizontal that a face looking down may have; 90° is upright.
  double overhang = radians(45);
  /// What may stand out freely.
  double step = 0.3;
  /// Span of a flat ceiling between two ends that are held.
  double bridge = 5.0;
  /// What lies no higher than this above the bed is pressed onto the bed.
  double first_layer = 0.3;
};

/// As a part lies, +z up and its lowest point on the bed. One Check each; `where` names the worst place and how much
/// of the part is beyond the limit:
/// - overhang (deg, at least): flattest slope of what looks down, small steps and bridges within their limits left out
/// - unsupported_step (mm, at most): furthest that a point of a face too flat is from what holds it, a bridge included
/// - bridge (mm, at most): longest span of a flat ceiling held at both ends, in the direction that suits it best
/// - island (1, exactly 0): places where material would begin in mid-air
/// The mesh should be a solid (check_mesh); one that cannot be measured fails all four.
std::vector<Check> check_print(const TriangleMesh& mesh, const PrintLimits& limits = {});

}  // namespace fusee
