/// \file
/// Internal: a number in the tree of a mechanism file.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string_view>

#include "mechanism/lengths.h"

namespace fusee {

/// The number that a node holds for a key, as written. A length is converted to mm: from `units`, or from the unit in
/// its text. Nullopt if the node holds no number.
inline std::optional<double> written_number(std::string_view key, const toml::node& node, LengthUnit units) {
  const bool length = is_length(key);
  if (length && node.is_string()) return parse_length(**node.as_string());
  if (!node.is_number()) return std::nullopt;
  const double value = *node.value<double>();
  return length ? to_mm(value, units) : value;
}

}  // namespace fusee
