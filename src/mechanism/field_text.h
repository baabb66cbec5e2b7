/// \file
/// Internal: texts about one field for messages, the writer, explain and the schema.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism_file.h"

namespace fusee {

/// "40 mm", "-5 %", "3".
std::string with_unit(double value, std::string_view unit);
/// Allowed values in a file of `units`: "1 to 10000 mm", "lowest <= 0 <= highest, both -180 to 180 deg", "\"exact\" or
/// \"paper\"".
std::string allowed_text(const Field& field, LengthUnit units = LengthUnit::mm);
/// The bounds of a number in a file of `units`: "1 to 10000 mm".
std::string bounds_text(const Field& field, LengthUnit units);
/// Kind of value in a file of `units`: "a number in mm", "two numbers [lowest, highest] in deg" …
std::string kind_text(const Field& field, LengthUnit units = LengthUnit::mm);
/// Text typed by the user, made printable: control characters, quotes and backslashes escaped, cut after `longest`
/// bytes.
std::string as_shown(std::string_view text, std::size_t longest = 60);
/// As as_shown(), in quotes.
std::string in_quotes(std::string_view text);
/// `"exact" or "paper"`.
std::string choices_text(const std::vector<std::string_view>& choices);
/// TOML basic string with its quotes.
std::string toml_string(std::string_view text);
/// "required", "required with law = \"linear\"", "default 40 mm".
std::string default_text(const Field& field);
/// Field::only_when in the file's syntax: `law = "linear"`.
std::string condition_text(const Field& field);

}  // namespace fusee
