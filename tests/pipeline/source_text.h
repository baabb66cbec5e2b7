/// \file
/// Our own sources as text, for tests that read them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fusee::house {

/// One file: its path below the source tree ("src/base/text.cpp"), and its text.
struct Source {
  std::string path;
  std::string text;
};

/// The text of a file of the source tree; "" when there is none.
std::string text_of(const std::filesystem::path& path);
/// Every .h and .cpp below these folders of the source tree, by path.
std::vector<Source> sources_under(const std::vector<std::string>& folders);

/// Comments, and what stands in quotes, as blanks: what is left is code, line for line where it was.
std::string code_of(std::string_view text);
/// 1 in the first line.
int line_at(std::string_view text, std::size_t offset);

}  // namespace fusee::house
