/// \file
#pragma once

#include <string>
#include <string_view>

namespace fusee {

/// The same STEP file with fewer bytes: values that stand twice (points, directions, styles) once, instances numbered
/// anew without gaps, and no space but in its texts.
std::string compact_step(std::string_view text);

}  // namespace fusee
