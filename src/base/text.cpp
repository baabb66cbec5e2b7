#include "fusee/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

namespace fusee {
namespace {

/// "-0", "-0.000" → without the sign.
std::string without_negative_zero(std::string text) {
  if (!text.empty() && text[0] == '-' && text.find_first_of("123456789", 1) == std::string::npos &&
      text.find_first_not_of("-0.", 0) == std::string::npos) {
    text.erase(0, 1);
  }
  return text;
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

}  // namespace

std::string shortest(double value) { return without_negative_zero(fmt::format("{}", value)); }

// Drawings hold numbers by the ten thousand: std::to_chars() rounds as fmt does, in a quarter of the time.
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
  const int before_point = static_cast<int>(std::floor(std::log10(size))) + 1;
  return trimmed_fixed(value, std::max(0, digits - before_point));
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
  // Every byte that does not continue one.
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string wrapped(std::string_view words, std::string_view first, std::string_view indent) {
  constexpr std::size_t k_width = 78;
  std::string text, line(first);
  bool has_word = false;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string_view word = words.substr(at, end - at);
    if (has_word && characters(line) + 1 + characters(word) > k_width) {
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
