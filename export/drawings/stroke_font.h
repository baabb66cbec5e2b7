/// \file
/// Text as open polylines: what a laser engraves in one pass, and what needs no font on the reader's machine. mm.
#pragma once

#include <string_view>
#include <vector>

#include "fusee/base/plane.h"

namespace fusee {

/// Strokes of one line of text, its lower left corner at `origin`, capitals `height` tall. Lower case is drawn as
/// capitals; a character without a glyph leaves a space.
std::vector<Polygon> stroke_text(std::string_view text, const Vec2& origin, double height);
/// Width of that line.
double stroke_text_width(std::string_view text, double height);

}  // namespace fusee
