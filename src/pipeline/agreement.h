/// \file
/// Do two files hold the same part?
#pragma once

#include <vector>

#include "fusee/base/check.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// "triangles": as many as in `reference`; "deviation": the corners of triangle i are those of triangle i of
/// `reference`, to the last bit of a float. For formats that keep every number and the order.
std::vector<Check> same_mesh(const TriangleMesh& reference, const TriangleMesh& other);

/// "triangles": as many as in `reference`; "deviation": every vertex of one lies within `tolerance` (mm) of a vertex of
/// the other. For formats that round and reorder.
std::vector<Check> near_mesh(const TriangleMesh& reference, const TriangleMesh& other, double tolerance);

}  // namespace fusee
