#include "measurement/log_text.h"

#include <array>

#include "base/text.h"

namespace fusee::measurement {
namespace {

unsigned char byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

/// Length in bytes of the UTF-8 character that begins at `at`; 0 if it is invalid (RFC 3629).
std::size_t character_length(std::string_view text, std::size_t at) {
  const unsigned char first = byte_at(text, at);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, at + i) & 0xC0) != 0x80) return 0;
  }
  return length;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string shown(std::string_view text) {
  constexpr std::size_t k_most_bytes = 40;
  std::string characters;
  std::size_t i = 0;
  while (i < text.size() && i < k_most_bytes) {
    const std::size_t length = character_length(text, i);
    // Control characters: U+0000 … U+001F, U+007F, and U+0080 … U+009F in two bytes.
    const bool is_control = byte_at(text, i) < 0x20 || byte_at(text, i) == 0x7F ||
                            (length == 2 && byte_at(text, i) == 0xC2 && byte_at(text, i + 1) < 0xA0);
    if (length == 0 || is_control) {
      characters += '?';
    } else {
      characters += text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return "\"" + characters + (i < text.size() ? "…\"" : "\"");
}

std::string quoted_list(const std::vector<std::string>& names) {
  constexpr std::size_t k_longest_list = 300;  // bytes, before the last name
  std::string list;
  for (const std::string& name : names) {
    if (!name.empty() && list.size() < k_longest_list) list += (list.empty() ? "" : ", ") + shown(name);
  }
  return list;
}

std::string to_utf8(std::string_view bytes) {
  // The bytes 0x80 to 0x9F of Windows-1252, which Windows writes where Latin-1 has controls.
  constexpr std::array<unsigned, 32> k_windows = {0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                                  0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0x8D,   0x017D, 0x8F,
                                                  0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                                  0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};
  if (is_utf8(bytes)) return std::string(bytes);
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    append_utf8(text, byte >= 0x80 && byte < 0xA0 ? k_windows.at(byte - 0x80U) : byte);
  }
  return text;
}

}  // namespace fusee::measurement
