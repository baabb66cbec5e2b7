#include "mechanism/nesting.h"

namespace fusee {
namespace {

constexpr int k_max_brackets = 16;
constexpr int k_max_dots = 16;  ///< of one dotted key

/// Index after the string that starts at `begin`, or the end of the text. TOML has four kinds: "…" and '…' on one line,
/// """…""" and '''…''' over several. A backslash escapes in the " kinds only.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const bool multiline = text.substr(begin, 3) == std::string(3, quote);
  std::size_t i = begin + (multiline ? 3 : 1);
  for (; i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (!multiline && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else if (multiline && text.substr(i, 3) == std::string(3, quote)) {
      return i + 3;
    }
  }
  return text.size();
}

}  // namespace

std::optional<Place> too_deep_place(std::string_view toml, const std::string& file) {
  int line = 1, brackets = 0, dots = 0;
  std::size_t line_begin = 0;
  for (std::size_t i = 0; i < toml.size();) {
    const char c = toml[i];
    if (c == '"' || c == '\'') {
      const std::size_t end = end_of_string(toml, i);
      for (; i < end; ++i) {
        if (toml[i] != '\n') continue;
        ++line;
        line_begin = i + 1;
      }
      continue;
    }
    if (c == '#') {
      i = std::min(toml.find('\n', i), toml.size());
      continue;
    }
    if (c == '[' || c == '{') ++brackets;
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    if (c == '.') ++dots;
    if (c == '=' || c == ',' || c == '\n' || c == '[' || c == '{') dots = 0;
    if (brackets > k_max_brackets || dots > k_max_dots) {
      return Place{file, line, static_cast<int>(i - line_begin) + 1};
    }
    if (c == '\n') {
      ++line;
      line_begin = i + 1;
    }
    ++i;
  }
  return std::nullopt;
}

}  // namespace fusee
