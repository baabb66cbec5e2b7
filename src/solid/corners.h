/// \file
/// What of a hole's outline in a mesh was meant. mm.
#pragma once

#include "fusee/base/plane.h"

namespace fusee {

/// Its corners alone: triangles of a wall leave points along its straight lines, and slicing leaves two where one was.
/// What stands out least from between its neighbours goes first; three are always left.
Polygon corners_of(Polygon corners);

}  // namespace fusee
