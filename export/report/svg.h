/// \file
/// Small pieces of SVG: numbers, paths, words, and a figure that stands in a page or in a file of its own. px, y down.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/plane.h"

namespace fusee {

/// A finished picture. Its colours are the classes of figure.css, so that it follows the page into dark mode and onto
/// paper.
struct Figure {
  double width = 0;
  double height = 0;
  std::string title;       ///< for those who cannot see it
  std::string body;        ///< SVG elements
  std::string attributes;  ///< more attributes of the svg element, " data-x=\"1\""
};

/// For use inside an HTML page that includes figure.css.
std::string inline_svg(const Figure& figure);
/// The same in a block of its own.
std::string in_div(const Figure& figure);
/// A file of its own, style included.
std::string standalone_svg(const Figure& figure);

/// Escaped for HTML and XML; control characters, which XML cannot hold, become U+FFFD.
std::string safe_text(std::string_view words);
/// Two decimals at most. A number that is not finite has no place on paper: 0, so that the picture stays readable.
std::string svg_number(double value);
/// " M x y L x y …": a point that is not finite breaks the line.
std::string path_data(const std::vector<Vec2>& points, bool closed);
std::string svg_path(std::string_view classes, const std::vector<Vec2>& points, bool closed = false);
std::string svg_line(std::string_view classes, const Vec2& from, const Vec2& to);
std::string svg_circle(std::string_view classes, const Vec2& centre, double radius);
/// `classes` may name the anchor: "start" (default), "middle", "end". `words` is escaped here.
std::string svg_words(std::string_view classes, const Vec2& at, std::string_view words);
/// Width that `words` will take at `font_size` in a sans-serif face, estimated from the count of characters.
double words_width(std::string_view words, double font_size);

/// Every point needed to stay within `tolerance` of the line (Douglas and Peucker): pictures need fewer points than
/// parts.
std::vector<Vec2> thinned(const std::vector<Vec2>& points, double tolerance);

/// A number as a person reads it: a true minus sign, "–" for what is not finite.
std::string readable(double value, int decimals);
/// The same to significant digits, "9·10⁻⁵" where it is very small or large.
std::string readable_rounded(double value, int digits = 4);

}  // namespace fusee
