/// \file
/// Internal: joins open paths with common ends.
#pragma once

#include <vector>

#include "fusee/export.h"

namespace fusee::formats {

/// Closes a path whose end is within k_joined (end_points.h) of its start, and removes the last point.
void close_where_ends_meet(DrawingPath& path);

/// Joins open paths of one layer where exactly two ends meet. A place where three or more meet stays open, because the
/// continuation is ambiguous.
std::vector<DrawingPath> joined_paths(std::vector<DrawingPath> paths);

}  // namespace fusee::formats
