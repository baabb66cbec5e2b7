/// \file
/// Internal: the Euler number of a mesh.
#pragma once

#include "fusee/solid.h"

namespace fusee::solid {

/// V − E + F of the welded surface. For one closed surface this is 2 − 2 × the number of through passages.
int euler_number(const TriangleMesh& mesh);

}  // namespace fusee::solid
