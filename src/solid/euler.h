/// \file
/// Internal: the ways through a solid, counted.
#pragma once

#include "fusee/solid/mesh.h"

namespace fusee {

/// V − E + F of the welded surface: 2 − 2 × the number of ways through, where it is one closed surface.
int euler_number(const TriangleMesh& mesh);

}  // namespace fusee
