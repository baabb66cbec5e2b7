/// \file
/// Internal: text as open polylines, which a laser engraves in one pass and which require no font. mm.
#pragma once

#include <string_view>
#include <vector>

#include "fusee/base.h"

namespace fusee::formats {

/// Strokes of one line of text with its lower left corner at `origin` and capitals of height `height`. Lower case is
/// drawn as capitals. A character without a glyph leaves a space.
std::vector<Polygon> stroke_text(std::string_view text, const Vec2& origin, double height);
/// Width of a line of text with capitals of height `height`.
double stroke_text_width(std::string_view text, double height);

}  // namespace fusee::formats
