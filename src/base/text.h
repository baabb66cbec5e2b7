/// \file
/// Locale-independent number formatting without negative zeros, and sanitizing of untrusted text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fusee {

/// The shortest text that reads back as the same double ("0.1", "1e+20", "-0" becomes "0").
std::string shortest(double value);
/// Fixed decimals, negative zero written as zero: fixed(-0.00001, 3) == "0.000".
std::string fixed(double value, int decimals);
/// Fixed decimals without trailing zeros: trimmed_fixed(2.50, 2) == "2.5", trimmed_fixed(3, 2) == "3".
std::string trimmed_fixed(double value, int decimals);
/// Number for messages: `digits` significant digits, no exponent between 1e-4 and 1e7 ("18.9", "0.0123").
std::string rounded(double value, int digits = 4);
/// Number of a text that these functions printed. In no locale does it depend on the decimal point of the C library.
double number_of(std::string_view printed);
/// Text without blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);
/// Text with A to Z as a to z.
std::string lower(std::string_view text);
/// Appends the UTF-8 encoding of a Unicode code point.
void append_utf8(std::string& text, std::uint32_t point);
/// UTF-8 of a text that begins with a UTF-16 byte-order mark of either order; nullopt for any other bytes. An unpaired
/// surrogate becomes U+FFFD.
std::optional<std::string> utf8_of_utf16(std::string_view bytes);
/// Number of characters in UTF-8 text.
std::size_t characters(std::string_view text);
bool is_utf8(std::string_view text);
/// Untrusted text (a name, a file, a bundle) made safe for a terminal, a page and XML. Line feeds and tabs are kept.
/// Replaced by U+FFFD are all other control characters (C0, DEL, C1), line separators, marks that reorder text
/// (bidirectional overrides, isolates), noncharacters and bytes that are not UTF-8.
std::string cleaned(std::string_view text);
/// As cleaned(), on one line: line feeds and tabs become blanks.
std::string cleaned_line(std::string_view text);
/// Text with the characters that cleaned() replaces escaped as in JSON strings; characters beyond U+FFFF become U+FFFD.
std::string unicode_escaped(std::string_view text);
/// Text wrapped to `width` characters, by default those of a terminal, each line with its line feed. The first line
/// begins with `first`, the others with `indent`. A word longer than a line stands alone.
std::string wrapped(std::string_view words, std::string_view first, std::string_view indent, std::size_t width = 78);
/// Text with & < > " ' as character references, safe in HTML, in XML and in quoted attributes.
std::string escape_html(std::string_view text);

}  // namespace fusee
