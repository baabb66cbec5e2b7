/// \file
/// Text tables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fusee::cli {

enum class Align { left, right };

struct Column {
  std::string_view title;
  Align align = Align::left;
};

/// A title line and one line per row, columns two spaces apart, without trailing blanks. Widths are in characters, not
/// bytes. In a table wider than 80 columns the cells of the widest columns are wrapped.
std::string table(const std::vector<Column>& columns, const std::vector<std::vector<std::string>>& rows);

/// A line of a title, indented by two blanks, and a text. The text begins `column` characters after the title begins,
/// or after a blank if the title is longer.
std::string titled(std::string title, const std::string& text, std::size_t column = 12);

}  // namespace fusee::cli
