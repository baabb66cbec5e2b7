/// \file
/// The project's sources as text, for tests that read them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fusee::house {

/// A file: its path below the source tree ("src/base/text.cpp"), and its text.
struct Source {
  std::string path;
  std::string text;
};

/// The text of a file of the source tree; "" when there is none.
std::string text_of(const std::filesystem::path& path);
/// All .h and .cpp files below these folders of the source tree, by path.
std::vector<Source> sources_under(const std::vector<std::string>& folders);

/// The text with comments and quoted text replaced by blanks; lines are kept.
std::string code_of(std::string_view text);
/// The line number of an offset; the first line is 1.
int line_at(std::string_view text, std::size_t offset);

}  // namespace fusee::house
