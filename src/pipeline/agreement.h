/// \file
/// Checks that two files contain the same part.
#pragma once

#include <vector>

#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::pipeline {

/// For formats that keep every number and the order. "triangles": equal counts; "deviation": triangle i of both has the
/// same corners, to the last bit of a float.
std::vector<Check> same_mesh(const solid::TriangleMesh& reference, const solid::TriangleMesh& other);

/// For formats that round and reorder. "triangles": equal counts; "deviation": every vertex of either mesh lies within
/// `tolerance` (mm) of a vertex of the other.
std::vector<Check> near_mesh(const solid::TriangleMesh& reference, const solid::TriangleMesh& other, double tolerance);

}  // namespace fusee::pipeline
