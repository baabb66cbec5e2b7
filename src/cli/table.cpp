#include "cli/table.h"

#include <algorithm>
#include <numeric>
#include <sstream>

#include "base/text.h"

namespace fusee::cli {
namespace {

std::string padded(std::string_view text, std::size_t width, Align align) {
  const std::string blanks(width - std::min(width, characters(text)), ' ');
  return align == Align::left ? std::string(text) + blanks : blanks + std::string(text);
}

/// The words of `cell` in lines of at most `most` characters.
std::vector<std::string> lines_of(std::string_view cell, std::size_t most) {
  std::vector<std::string> lines;
  std::istringstream text(wrapped(cell, "", "", most));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Narrows the widest columns of a table that is wider than a terminal of 80 columns.
void fit_terminal(std::vector<std::size_t>& widths) {
  constexpr std::size_t k_terminal = 80, k_least = 16;  // characters; narrower cells are unreadable
  while (std::accumulate(widths.begin(), widths.end(), 2 * (widths.size() - 1)) > k_terminal) {
    std::size_t& widest = *std::max_element(widths.begin(), widths.end());
    if (widest <= k_least) return;
    --widest;
  }
}

}  // namespace

std::string table(const std::vector<Column>& columns, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::size_t widest = characters(columns[i].title);
    for (const auto& row : rows) widest = std::max(widest, characters(row[i]));
    widths.push_back(widest);
  }
  fit_terminal(widths);
  std::string text;
  const auto add_line = [&](const auto& cell) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i)
      line += (i ? "  " : "") + padded(cell(i), widths[i], columns[i].align);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  add_line([&](std::size_t i) { return columns[i].title; });
  for (const auto& row : rows) {
    std::vector<std::vector<std::string>> cells;
    std::size_t lines = 1;
    for (std::size_t i = 0; i < row.size(); ++i) {
      cells.push_back(lines_of(row[i], widths[i]));
      lines = std::max(lines, cells.back().size());
    }
    for (std::size_t k = 0; k < lines; ++k)
      add_line([&](std::size_t i) { return k < cells[i].size() ? cells[i][k] : std::string(); });
  }
  return text;
}

std::string titled(std::string title, const std::string& text, std::size_t column) {
  title.resize(std::max(column, title.size() + 1), ' ');
  return "  " + title + text + "\n";
}

}  // namespace fusee::cli
