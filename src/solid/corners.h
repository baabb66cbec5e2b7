/// \file
/// Internal: restores a hole's outline from a section of a mesh. mm.
#pragma once

#include "fusee/base.h"

namespace fusee::solid {

/// Keeps the true corners only. Triangulation adds points along straight edges, and slicing may split one point in two.
/// Points that project least from the line between their neighbours are removed first. At least three remain.
Polygon corners_of(Polygon corners);

}  // namespace fusee::solid
