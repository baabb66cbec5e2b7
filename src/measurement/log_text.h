/// \file
/// Internal: helpers for the text of a log. Text is UTF-8 unless stated otherwise.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fusee::measurement {

/// Removes blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);
/// Quotes text for a message: control characters become ?, and text of more than 40 bytes is cut.
std::string shown(std::string_view text);
/// Names in quotes, with commas; a long list is cut.
std::string quoted_list(const std::vector<std::string>& names);
/// Converts Latin-1 or Windows-1252 to UTF-8; UTF-8 is unchanged.
std::string to_utf8(std::string_view bytes);

}  // namespace fusee::measurement
