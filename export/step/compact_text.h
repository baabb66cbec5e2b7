/// \file
/// Internal: smaller text of a STEP file.
#pragma once

#include <string>
#include <string_view>

namespace fusee::formats {

/// Compacts a STEP file: equal values (points, directions, styles) are merged, instances are renumbered without gaps,
/// reals are shortened to ten digits, and spaces remain in texts only.
std::string compact_step(std::string_view text);

}  // namespace fusee::formats
