/// \file
/// Does a part print as it lies, without supports? Measured on the mesh that was written, not on what was meant. mm,
/// rad.
#pragma once

#include <vector>

#include "fusee/base/check.h"
#include "fusee/base/units.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// What a desktop printer bears: the reasons stand in check_print.cpp.
struct PrintLimits {
  double overhang =
      radians(45);           ///< flattest slope above the horizontal that a face looking down may have; 90° is upright
  double step = 0.3;         ///< what may stand out freely
  double bridge = 5.0;       ///< between two ends that are held
  double first_layer = 0.3;  ///< what lies lower than this above the bed is pressed onto the bed
};

/// How a part prints, +z up, its lowest point on the bed; one Check each, `where` naming the worst place and how much
/// is like it:
/// - overhang (deg, at least): flattest slope of what looks down and is no step and no bridge that may be
/// - unsupported_step (mm, at most): furthest that a point of a face too flat is from what holds it, bridges included
/// - bridge (mm, at most): longest span of a flat ceiling that is held at both ends, along the direction that suits the
/// ceiling best
/// - island (1, exactly 0): places where material begins in mid-air
/// The mesh must be a solid (check_mesh); of an empty one nothing is measured and everything fails.
std::vector<Check> check_print(const TriangleMesh& mesh, const PrintLimits& limits = {});

}  // namespace fusee
