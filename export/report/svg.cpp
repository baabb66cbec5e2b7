#include "export/report/svg.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "export/report/report_parts.h"

namespace fusee::formats {
namespace {

constexpr std::string_view k_minus = "\u2212";

std::string with_true_minus(const std::string& number) {
  std::string text;
  for (const char c : number) {
    if (c == '-') {
      text += k_minus;
    } else {
      text += c;
    }
  }
  return text;
}

std::string superscript(int number) {
  constexpr std::string_view k_digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(number)) text += c == '-' ? std::string_view("⁻") : k_digits[c - '0'];
  return text;
}

// `attributes`: further classes, the quotation mark that ends them, and further attributes.
std::string svg_element(const Figure& figure, std::string_view attributes, std::string_view style) {
  std::string svg = "<svg class=\"figure";
  svg += attributes;
  svg += " viewBox=\"0 0 " + svg_number(figure.width) + " " + svg_number(figure.height) + "\" role=\"img\"" +
         figure.attributes;
  svg += "><title>" + safe_text(figure.title) + "</title>";
  svg += style;
  return svg + figure.body + "</svg>\n";
}

}  // namespace

// The drawing's width, --w, lets page.css keep its texts readable.
std::string inline_svg(const Figure& figure) {
  const auto attributes = [](const Figure& one, std::string_view name) {
    return std::string(name) + "\" style=\"--w:" + svg_number(one.width) + "\"";
  };
  if (figure.narrow.empty()) return svg_element(figure, attributes(figure, ""), "");
  const Figure& narrow = figure.narrow.front();
  return svg_element(figure, attributes(figure, " wide"), "") + svg_element(narrow, attributes(narrow, " narrow"), "");
}

std::string in_div(const Figure& figure) { return "<div>" + inline_svg(figure) + "</div>\n"; }

std::string standalone_svg(const Figure& figure) {
  const std::string size = "\" xmlns=\"http://www.w3.org/2000/svg\" width=\"" + svg_number(figure.width) +
                           "\" height=\"" + svg_number(figure.height) + "\"";
  const std::string style = "<style>" + std::string(embedded::figure_css) + "</style>";
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + svg_element(figure, size, style);
}

std::string safe_text(std::string_view words) { return escape_html(cleaned(words)); }

std::string svg_number(double value) {
  if (!std::isfinite(value)) return "0";
  return trimmed_fixed(std::clamp(value, -1e6, 1e6), 2);
}

std::string path_data(const std::vector<Vec2>& points, bool closed) {
  std::string data;
  bool pen_down = false;
  for (const Vec2& point : points) {
    if (!point.allFinite()) {
      pen_down = false;
      continue;
    }
    data += (pen_down ? "L" : "M") + svg_number(point.x()) + " " + svg_number(point.y());
    pen_down = true;
  }
  if (closed && pen_down) data += "Z";
  return data;
}

std::string svg_path(std::string_view classes, const std::vector<Vec2>& points, bool closed) {
  return "<path class=\"" + std::string(classes) + "\" d=\"" + path_data(points, closed) + "\"/>";
}

std::string svg_line(std::string_view classes, const Vec2& from, const Vec2& to) {
  return svg_path(classes, {from, to});
}

std::string svg_circle(std::string_view classes, const Vec2& centre, double radius) {
  return "<circle class=\"" + std::string(classes) + "\" cx=\"" + svg_number(centre.x()) + "\" cy=\"" +
         svg_number(centre.y()) + "\" r=\"" + svg_number(radius) + "\"/>";
}

std::string svg_words(std::string_view classes, const Vec2& at, std::string_view words) {
  return "<text class=\"" + std::string(classes) + "\" x=\"" + svg_number(at.x()) + "\" y=\"" + svg_number(at.y()) +
         "\">" + safe_text(words) + "</text>";
}

double words_width(std::string_view words, double font_size) {
  constexpr double k_mean_width = 0.56;  // of a character, as a share of the font size
  return k_mean_width * font_size * static_cast<double>(characters(words));
}

std::vector<Vec2> thinned(const std::vector<Vec2>& points, double tolerance) {
  if (points.size() < 3) return points;
  std::vector<bool> kept(points.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans{{0, points.size() - 1}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    const Vec2 chord = points[last] - points[first];
    const double length = chord.norm();
    double worst = tolerance;
    std::size_t split = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const Vec2 offset = points[i] - points[first];
      const double distance = length > 0 ? std::abs(cross(chord, offset)) / length : offset.norm();
      // Written so that NaN is kept and invalid points remain visible.
      if (!(distance <= worst)) {
        worst = distance;
        split = i;
        if (std::isnan(distance)) break;
      }
    }
    if (split == first) continue;
    kept[split] = true;
    spans.emplace_back(first, split);
    spans.emplace_back(split, last);
  }
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (kept[i]) result.push_back(points[i]);
  }
  return result;
}

std::string readable(double value, int decimals) {
  return std::isfinite(value) ? with_true_minus(fixed(value, decimals)) : "–";
}

std::string readable_rounded(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  const std::string number = rounded(value, digits);
  const std::size_t exponent = number.find('e');
  if (exponent == std::string::npos) return with_true_minus(number);
  return with_true_minus(number.substr(0, exponent)) + "·10" + superscript(std::stoi(number.substr(exponent + 1)));
}

std::string interval_words(double low, double high, int digits) {
  constexpr int k_most_digits = 9;
  if (low < high) {
    while (digits < k_most_digits && rounded(low, digits) == rounded(high, digits)) ++digits;
  }
  return readable_rounded(low, digits) + " … " + readable_rounded(high, digits);
}

}  // namespace fusee::formats
