/// \file
/// Columns of text for a person.
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

/// A title line and one line a row, columns two spaces apart, without trailing blanks. Widths count characters, not
/// bytes. In a table wider than 80 columns the cells of the widest columns are
/// wrapped.
std::string table(const std::vector<Column>& columns, const std::vector<std::vector<std::string>>& rows);

/// What a number or a finding is called, and behind it, from `column` on or after a blank, what it is.
std::string titled(std::string title, const std::string& text, std::size_t column = 12);

}  // namespace fusee::cli
