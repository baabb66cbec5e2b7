/// \file
/// Do two files hold the same part?
#pragma once

#include <vector>

#include "fusee/base/check.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// "triangles": as many as in `reference`; "deviation": no corner of a triangle is further than `tolerance` (mm) from
/// the same corner in `reference`. The triangles of both must be in the same order.
std::vector<Check> agreement(const TriangleMesh& reference, const TriangleMesh& other, double tolerance);

}  // namespace fusee
