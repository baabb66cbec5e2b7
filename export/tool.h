/// \file
/// Internal: the name of the program in the files that it writes.
#pragma once

#include <string_view>

namespace fusee::formats {

/// "fusee 0.2.0". base/leftovers.cpp recognises an earlier run by the first word of a manifest's "tool".
inline constexpr std::string_view k_tool = "fusee " FUSEE_VERSION;

}  // namespace fusee::formats
