/// \file
/// What fusee calls itself in the files it writes.
#pragma once

#include <string_view>

namespace fusee {

/// "fusee 0.1.0". base/files.cpp knows an earlier run by the first word of a manifest's "tool".
inline constexpr std::string_view k_tool = "fusee " FUSEE_VERSION;

}  // namespace fusee
