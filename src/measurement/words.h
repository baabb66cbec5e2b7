/// \file
/// Internal: text of a log, which is UTF-8 by the time that it comes here.
#pragma once

#include <string>
#include <string_view>

namespace fusee {

/// Without the blanks and tabs around it.
std::string_view trimmed(std::string_view text);
/// A to Z in lower case; other letters as they are.
std::string lower(std::string_view text);
/// In quotation marks, as a message may show it: control characters as ?, long text cut off.
std::string shown(std::string_view text);
/// Latin-1 becomes UTF-8; what is UTF-8 stays.
std::string to_utf8(std::string_view bytes);

}  // namespace fusee
