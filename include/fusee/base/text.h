/// \file
/// Numbers to text, the same on every machine: no locale, no trailing noise, no negative zero. Foreign text, made safe.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fusee {

/// The shortest text that reads back as the same double ("0.1", "1e+20", "-0" becomes "0").
std::string shortest(double value);
/// Fixed decimals, negative zero written as zero: fixed(-0.00001, 3) == "0.000".
std::string fixed(double value, int decimals);
/// The same without trailing zeros: trimmed_fixed(2.50, 2) == "2.5", trimmed_fixed(3, 2) == "3".
std::string trimmed_fixed(double value, int decimals);
/// For messages: `digits` significant digits, no exponent between 1e-4 and 1e7 ("18.9", "0.0123").
std::string rounded(double value, int digits = 4);
/// The UTF-8 of a text that begins with UTF-16's byte-order mark, of either order; nothing of any other bytes. Half a
/// surrogate pair becomes U+FFFD.
std::optional<std::string> utf8_of_utf16(std::string_view bytes);
/// Characters of UTF-8 text.
std::size_t characters(std::string_view text);
bool is_utf8(std::string_view text);
/// Text from outside (a name, a file, a bundle) fit for a terminal, a page and XML: line feeds and tabs stay; every other
/// control character (C0, DEL, C1), line separator, mark that reorders text (bidirectional overrides, isolates), code
/// point that is no character, and byte that is no UTF-8 becomes U+FFFD.
std::string cleaned(std::string_view text);
/// The same on one line: line feeds and tabs become blanks.
std::string cleaned_line(std::string_view text);
/// The same characters escaped as in JSON strings; what no such escape names becomes U+FFFD.
std::string unicode_escaped(std::string_view text);
/// Words broken into lines of the terminal's usual width, each with its end: the first begins with `first`, the others
/// with `indent`. A word that is longer stands alone.
std::string wrapped(std::string_view words, std::string_view first, std::string_view indent);
/// JSON/JavaScript-safe and HTML-safe text.
std::string escape_html(std::string_view text);

}  // namespace fusee
