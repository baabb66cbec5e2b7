#include "export/drawings/sheet_notes.h"

#include <algorithm>

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
    const std::string lines = wrapped(note, "", "", most);
    for (std::size_t begin = 0; begin < lines.size();) {
      // A word longer than the sheet is broken.
      const std::size_t end = std::min(lines.find('\n', begin), begin + most);
      drawing.add_text("NOTES", lines.substr(begin, end - begin), {0, y}, k_text_height);
      y -= k_line_pitch;
      begin = lines[end] == '\n' ? end + 1 : end;
    }
  }
}

}  // namespace fusee::formats
