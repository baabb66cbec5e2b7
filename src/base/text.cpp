#include "fusee/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
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
