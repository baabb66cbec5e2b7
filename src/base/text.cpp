#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <system_error>

#include "fusee/base_elementary.h"

namespace fusee {
namespace {

/// Removes the sign of "-0" and "-0.000".
std::string without_negative_zero(std::string text) {
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  if (is_zero && text.starts_with('-')) text.erase(0, 1);
  return text;
}

/// Removes one UTF-8 character from the front of `text`. If it is not well formed, removes its longest well-formed
/// prefix and returns nullopt, as JSON writers do. Overlong forms, surrogates and values above U+10FFFF are not well
/// formed (Unicode 15, table 3-7).
std::optional<char32_t> take_character(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  // Bytes of the character; 0 if no character begins with this byte.
  const std::size_t size = lead < 0x80 ? 1 : lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
  char32_t code = size < 2 ? lead : lead & (0x7F >> size);
  std::size_t taken = 1;
  // Bounds of the next byte. Those of the second byte exclude overlong forms, surrogates and values above U+10FFFF.
  unsigned char least = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
  unsigned char most = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
  for (; taken < size && taken < text.size(); ++taken) {
    const auto byte = static_cast<unsigned char>(text[taken]);
    if (byte < least || byte > most) break;
    code = (code << 6) | (byte & 0x3F);
    least = 0x80;
    most = 0xBF;
  }
  text.remove_prefix(taken);
  return taken == size ? std::optional(code) : std::nullopt;
}

/// False for the characters that cleaned() replaces. Line feeds and tabs count as control characters here.
bool is_displayable(char32_t code) {
  const auto within = [code](char32_t first, char32_t last) { return code >= first && code <= last; };
  const bool control = code < 0x20 || within(0x7F, 0x9F) || within(0x2028, 0x2029);
  const bool reorders = within(0x202A, 0x202E) || within(0x2066, 0x2069) || within(0x200E, 0x200F) || code == 0x061C;
  const bool no_character = (code & 0xFFFE) == 0xFFFE || within(0xFDD0, 0xFDEF);
  return !control && !reorders && !no_character;
}

/// Copies `text`. Replaces each character that is not displayable, no line feed and no tab by `replacement(code)`.
/// `code` is nullopt for malformed bytes.
template <class Replacement>
std::string with_replacements(std::string_view text, const Replacement& replacement) {
  std::string copy;
  copy.reserve(text.size());
  while (!text.empty()) {
    const std::string_view before = text;
    const std::optional<char32_t> code = take_character(text);
    if (code && (is_displayable(*code) || code == U'\n' || code == U'\t')) {
      copy += before.substr(0, before.size() - text.size());
    } else {
      copy += replacement(code);
    }
  }
  return copy;
}

constexpr std::string_view k_replacement = "\uFFFD";

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view k_blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(k_blanks);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(k_blanks) - first + 1);
}

std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return small;
}

void append_utf8(std::string& text, std::uint32_t point) {
  const auto put = [&text](std::uint32_t byte) { text += static_cast<char>(byte); };
  const auto follow = [&](int shift) { put(0x80 | ((point >> shift) & 0x3F)); };
  if (point < 0x80) {
    put(point);
  } else if (point < 0x800) {
    put(0xC0 | point >> 6);
    follow(0);
  } else if (point < 0x10000) {
    put(0xE0 | point >> 12);
    follow(6);
    follow(0);
  } else {
    put(0xF0 | point >> 18);
    follow(12);
    follow(6);
    follow(0);
  }
}

bool is_utf8(std::string_view text) {
  // Fast path: most text is ASCII, and logs of a million rows are checked line by line.
  unsigned char all = 0;
  for (const char c : text) all |= static_cast<unsigned char>(c);
  if (all < 0x80) return true;
  while (!text.empty())
    if (!take_character(text)) return false;
  return true;
}

std::string cleaned(std::string_view text) {
  return with_replacements(text, [](std::optional<char32_t>) { return k_replacement; });
}

std::string cleaned_line(std::string_view text) {
  std::string line = cleaned(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return line;
}

std::string unicode_escaped(std::string_view text) {
  return with_replacements(text, [](std::optional<char32_t> code) {
    const bool one_unit = code && *code < 0x10000;  // an escape holds one UTF-16 unit
    return one_unit ? fmt::format("\\u{:04x}", static_cast<unsigned>(*code)) : std::string(k_replacement);
  });
}

std::string shortest(double value) { return without_negative_zero(fmt::format("{}", value)); }

// Drawings contain tens of thousands of numbers. std::to_chars() gives the text of fmt in a quarter of the time.
std::string fixed(double value, int decimals) {
  std::array<char, 512> text;
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
  if (error != std::errc() || !std::isfinite(value))
    return without_negative_zero(fmt::format("{:.{}f}", value, decimals));
  return without_negative_zero(std::string(text.data(), end));
}

std::string trimmed_fixed(double value, int decimals) {
  std::string text = fixed(value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

std::string rounded(double value, int digits) {
  const double size = std::abs(value);
  if (value == 0 || !std::isfinite(value) || size < 1e-4 || size >= 1e7) {
    return without_negative_zero(fmt::format("{:.{}g}", value, digits));
  }
  const int before_point = static_cast<int>(std::floor(elementary::log10(size))) + 1;
  return trimmed_fixed(value, std::max(0, digits - before_point));
}

double number_of(std::string_view printed) {
  double value = 0;
  std::from_chars(printed.data(), printed.data() + printed.size(), value);
  return value;
}

std::optional<std::string> utf8_of_utf16(std::string_view bytes) {
  const bool big_endian = bytes.starts_with("\xFE\xFF");
  if (!big_endian && !bytes.starts_with("\xFF\xFE")) return std::nullopt;
  const auto unit_at = [&](std::size_t at) -> std::uint32_t {
    if (at + 1 >= bytes.size()) return 0;
    const auto byte = [&](std::size_t k) { return std::uint32_t{static_cast<unsigned char>(bytes[k])}; };
    return byte(big_endian ? at : at + 1) << 8 | byte(big_endian ? at + 1 : at);
  };
  std::string text;
  for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
    std::uint32_t point = unit_at(at);
    const std::uint32_t next = unit_at(at + 2);
    if (point >= 0xD800 && point < 0xDC00 && next >= 0xDC00 && next < 0xE000) {
      point = 0x10000 + ((point - 0xD800) << 10) + (next - 0xDC00);
      at += 2;
    } else if (point >= 0xD800 && point < 0xE000) {
      point = 0xFFFD;
    }
    append_utf8(text, point);
  }
  return text;
}

std::size_t characters(std::string_view text) {
  // Counts the bytes that are not continuation bytes.
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string wrapped(std::string_view words, std::string_view first, std::string_view indent, std::size_t width) {
  std::string text, line(first);
  bool has_word = false;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string_view word = words.substr(at, end - at);
    if (has_word && characters(line) + 1 + characters(word) > width) {
      text += line + "\n";
      line = indent;
      has_word = false;
    }
    line += (has_word ? " " : "") + std::string(word);
    has_word = true;
    at = end + 1;
  }
  return text + line + "\n";
}

std::string escape_html(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace fusee
