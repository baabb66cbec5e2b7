/// \file
/// Internal: keeps deep nesting away from toml++, whose tables are destroyed recursively.
#pragma once

#include <optional>
#include <string_view>

#include "fusee/base/diagnostics.h"

namespace fusee {

/// Where brackets or a dotted key nest deeper than any mechanism file does, or null. Strings and comments are passed
/// over.
std::optional<Place> too_deep_place(std::string_view toml, const std::string& file);

}  // namespace fusee
