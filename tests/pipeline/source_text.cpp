#include "pipeline/source_text.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

namespace fusee::house {
namespace {

namespace fs = std::filesystem;

const fs::path k_root = FUSEE_SOURCE_DIR;

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// End of the quotation that begins with `quote` at `at`; a backslash escapes the next character.
std::size_t end_of_quoted(std::string_view text, std::size_t at, char quote) {
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      return i + 1;
    }
  }
  return text.size();
}

std::size_t end_after(std::string_view text, std::string_view mark, std::size_t from) {
  const std::size_t found = text.find(mark, from);
  return found == std::string_view::npos ? text.size() : found + mark.size();
}

/// End of R"mark( … )mark"; `at` is the index of the quotation mark.
std::size_t end_of_raw(std::string_view text, std::size_t at) {
  const std::size_t open = std::min(text.find('(', at), text.size() - 1);
  return end_after(text, ")" + std::string(text.substr(at + 1, open - at - 1)) + "\"", open);
}

/// End of the comment or quotation that begins at `at`; `at` if there is none.
std::size_t end_of_no_code(std::string_view text, std::size_t at) {
  const char before = at > 0 ? text[at - 1] : ' ';
  const std::string_view pair = text.substr(at, 2);
  if (pair == "//") return std::min(text.find('\n', at), text.size());
  if (pair == "/*") return end_after(text, "*/", at + 2);
  if (text[at] == '"') return before == 'R' ? end_of_raw(text, at) : end_of_quoted(text, at, '"');
  if (text[at] == '\'' && !is_word(before)) return end_of_quoted(text, at, '\'');  // not 1'000
  return at;
}

}  // namespace

std::string text_of(const fs::path& path) {
  std::ifstream stream(k_root / path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<Source> sources_under(const std::vector<std::string>& folders) {
  std::vector<Source> sources;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(k_root / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".h" && ending != ".cpp") continue;
      const fs::path path = fs::relative(entry.path(), k_root);
      sources.push_back({path.generic_string(), text_of(path)});
    }
  }
  std::sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) { return a.path < b.path; });
  return sources;
}

std::string code_of(std::string_view text) {
  std::string code(text);
  for (std::size_t at = 0; at < code.size();) {
    const std::size_t end = end_of_no_code(text, at);
    for (std::size_t i = at; i < end; ++i) {
      if (code[i] != '\n') code[i] = ' ';
    }
    at = std::max(end, at + 1);
  }
  return code;
}

int line_at(std::string_view text, std::size_t offset) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

}  // namespace fusee::house
