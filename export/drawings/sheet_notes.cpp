#include "export/drawings/sheet_notes.h"

#include <string_view>

#include "base/text.h"
#include "export/drawings/plane_shapes.h"
#include "export/drawings/stroke_font.h"

namespace fusee::formats {
namespace {

constexpr double k_text_height = 3;
constexpr double k_line_pitch = 5;
constexpr double k_below_sheet = 5;  // distance of the first line from the sheet

/// Number of characters that fit into a width, at least one.
std::size_t characters_in(double width) {
  std::size_t count = 1;
  while (stroke_text_width(std::string(count + 1, 'M'), k_text_height) <= width) ++count;
  return count;
}

/// Takes the first line of at most `most` characters from a text: up to a blank if there is one.
std::string_view take_line(std::string_view& text, std::size_t most) {
  std::size_t end = text.size();
  if (end > most) {
    const std::size_t blank = text.rfind(' ', most);
    end = blank == std::string_view::npos || blank == 0 ? most : blank;
  }
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end < text.size() && text[end] == ' ' ? end + 1 : end);
  return line;
}

}  // namespace

Polygon check_square(double kerf) { return rectangle({0, 0}, Vec2::Constant(10 + kerf)); }

std::string kerf_remark(double kerf) {
  return "lines are the centre of the cut: outlines half a kerf (" + rounded(0.5 * kerf) +
         " mm) outside, holes half a kerf inside; the square of CHECK_10MM is 10 mm wide after the cut";
}

void add_sheet_notes(DxfDocument& drawing, const std::vector<std::string>& notes, double sheet_width) {
  const std::size_t most = characters_in(sheet_width);
  double y = -k_below_sheet - k_text_height;
  for (const std::string& note : notes) {
    std::string_view rest = note;
    do {
      drawing.add_text("NOTES", take_line(rest, most), {0, y}, k_text_height);
      y -= k_line_pitch;
    } while (!rest.empty());
  }
}

}  // namespace fusee::formats
