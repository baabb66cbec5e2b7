/// \file
/// Checks whether a part prints without supports in its print orientation. Measured on the mesh as written.
#pragma once

#include <vector>

#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::solid {

/// Limits of a desktop printer, rad and mm. check_print.cpp gives the reasons.
struct PrintLimits {
  /// Least angle of a downward face above the horizontal; 90° is upright.
  double overhang = radians(45);
  /// Longest free overhang.
  double step = 0.3;
  /// Longest span of a flat ceiling supported at both ends.
  double bridge = 5.0;
  /// Height up to which material is pressed onto the bed.
  double first_layer = 0.3;
};

/// Checks a part in its print orientation, +z up and the lowest point on the bed. One Check each, with `where` naming
/// the worst place and the extent beyond the limit:
///   - overhang (deg, at least): flattest slope of downward faces, except small steps and bridges within their limits
///   - unsupported_step (mm, at most): longest distance from the points of too flat faces to their support, where a
///     bridge counts as support
///   - bridge (mm, at most): longest span of a flat ceiling supported at both ends, in its most favourable direction
///   - island (1, exactly 0): places where material would begin in mid-air
/// The mesh should be a solid (check_mesh). One that cannot be measured fails all four checks.
std::vector<Check> check_print(const TriangleMesh& mesh, const PrintLimits& limits = {});

}  // namespace fusee::solid
