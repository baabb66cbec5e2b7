/// \file
/// Internal: rejects deep nesting, because toml++ destroys tables recursively.
#pragma once

#include <optional>
#include <string_view>

#include "fusee/base.h"

namespace fusee {

/// The place where brackets or a dotted key nest deeper than in any mechanism file, or null. Strings and comments are
/// skipped.
std::optional<Place> too_deep_place(std::string_view toml, const std::string& file);

}  // namespace fusee
