/// \file
/// Open paths that go on in one another become one.
#pragma once

#include <vector>

#include "fusee/export/drawings.h"

namespace fusee {

/// A path that ends within k_joined (end_points.h) of where it began is closed, and that last point goes.
void close_where_ends_meet(DrawingPath& path);

/// Joins open paths of one layer where exactly two ends meet; a place where three or more meet stays open, for nobody
/// knows which go on.
std::vector<DrawingPath> joined_paths(std::vector<DrawingPath> paths);

}  // namespace fusee
