/// \file
/// Internal: elements of SVG: numbers, paths, words, and a figure for a page or a file. px, y down.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"

namespace fusee::formats {

/// A finished picture. Its colours are the classes of figure.css, so that it adapts to dark mode and to paper.
struct Figure {
  double width = 0;
  double height = 0;
  std::string title;       ///< alternative text
  std::string body;        ///< SVG elements
  std::string attributes;  ///< more attributes of the svg element, such as " data-x=\"1\""
  /// Layout of this figure for a narrow column. If empty, the figure is scaled.
  std::vector<Figure> narrow = {};
};

/// An SVG for an HTML page with figure.css and page.css, which select the layout that fits the column.
std::string inline_svg(const Figure& figure);
/// The figure in a div.
std::string in_div(const Figure& figure);
/// A separate file, style included.
std::string standalone_svg(const Figure& figure);

/// Escaped for HTML and XML. Control characters, which XML cannot hold, become U+FFFD.
std::string safe_text(std::string_view words);
/// At most two decimals. A number that is not finite becomes 0, so that the picture stays readable.
std::string svg_number(double value);
/// "Mx yLx y…": a point that is not finite breaks the line.
std::string path_data(const std::vector<Vec2>& points, bool closed);
std::string svg_path(std::string_view classes, const std::vector<Vec2>& points, bool closed = false);
std::string svg_line(std::string_view classes, const Vec2& from, const Vec2& to);
std::string svg_circle(std::string_view classes, const Vec2& centre, double radius);
/// `classes` may name the anchor: "start" (default), "middle", "end". `words` is escaped here.
std::string svg_words(std::string_view classes, const Vec2& at, std::string_view words);
/// Width of `words` at `font_size` in a sans-serif face, estimated from the number of characters.
double words_width(std::string_view words, double font_size);

/// The points needed to stay within `tolerance` of the line (Douglas and Peucker), because pictures require fewer
/// points than parts.
std::vector<Vec2> thinned(const std::vector<Vec2>& points, double tolerance);

/// A number for display: a true minus sign, "–" if it is not finite.
std::string readable(double value, int decimals);
/// A number to significant digits, "9·10⁻⁵" if it is very small or large.
std::string readable_rounded(double value, int digits = 4);
/// "12.18 … 12.23": the ends to as many digits as it takes to be different.
std::string interval_words(double low, double high, int digits = 4);

}  // namespace fusee::formats
