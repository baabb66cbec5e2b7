#include "export/report/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/text.h"

namespace fusee::formats {
namespace {

constexpr double k_small_font = 12;
constexpr double k_tick_pitch = 65;  // least usual distance of labels along x
/// Larger values and NaN are not drawn, because no axis could show them together with others.
constexpr double k_largest = 1e15;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    if (!(std::abs(value) < k_largest)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double span() const { return high - low; }
};

/// The range widened about its middle to at least `least` and 1e-9 of its values; [0, 1] if it is empty.
Range usable(Range range, double least) {
  if (!(range.low <= range.high)) return {0, 1};
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  const double wanted = std::max({least, 1e-9 * size, range.span()});
  const double span = wanted > 0 ? wanted : 1;
  const double middle = 0.5 * (range.low + range.high);
  return span > range.span() ? Range{middle - 0.5 * span, middle + 0.5 * span} : range;
}

/// Maps values to the paper.
struct Frame {
  Range x, y;
  double left, top, width, height;
  std::vector<double> x_ticks, y_ticks;

  Vec2 operator()(const Vec2& value) const {
    return {left + (value.x() - x.low) / x.span() * width, top + (y.high - value.y()) / y.span() * height};
  }
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

Range forced(Range range, const PlotAxis& axis) {
  if (axis.low) range.low = *axis.low;
  if (axis.high) range.high = *axis.high;
  return usable(range, axis.least_span);
}

double step_of(const std::vector<double>& ticks) { return ticks[1] - ticks[0]; }

std::string tick_label(double value, double step) {
  const double size = std::max(std::abs(value), std::abs(step));
  if (size != 0 && (size >= 1e6 || std::abs(step) < 1e-5)) return readable_rounded(value, 3);
  return readable(value, tick_decimals(step));
}

Frame make_frame(const Plot& plot, double extra_height) {
  Range x, y;
  for (const PlotSeries& series : plot.series) {
    for (const Vec2& point : series.points) {
      if (!point.allFinite()) continue;
      x.include(point.x());
      y.include(point.y());
    }
  }
  for (const PlotLimit& limit : plot.limits) y.include(limit.y);
  for (const PlotMark& mark : plot.marks) y.include(mark.at.y());
  Frame frame;
  frame.x = forced(x, plot.x);
  const Range wanted = forced(y, plot.y);
  frame.y_ticks = nice_ticks(wanted.low, wanted.high, 5, plot.y.unit);
  frame.y = {frame.y_ticks.front(), frame.y_ticks.back()};
  frame.x_ticks = nice_ticks(frame.x.low, frame.x.high, static_cast<int>(plot.width / k_tick_pitch), plot.x.unit);
  // The stroke fills the width, because ticks beyond its ends would only add empty space.
  const double tolerance = 1e-9 * frame.x.span();
  std::erase_if(frame.x_ticks, [&](double t) { return t < frame.x.low - tolerance || t > frame.x.high + tolerance; });
  double label_width = 0;
  for (const double tick : frame.y_ticks) {
    label_width = std::max(label_width, words_width(tick_label(tick, step_of(frame.y_ticks)), k_small_font));
  }
  // Margins: name of y and its labels to the left, title and legend above, labels and name of x below.
  frame.left = 34 + label_width;
  frame.top = 58 + extra_height;
  frame.width = plot.width - frame.left - 14;
  frame.height = plot.height - frame.top - 48;
  return frame;
}

std::string axis_words(const PlotAxis& axis) {
  return axis.unit.empty() ? axis.label : axis.label + " (" + axis.unit + ")";
}

std::string x_axis(const Plot& plot, const Frame& frame) {
  const double step = frame.x_ticks.size() > 1 ? step_of(frame.x_ticks) : frame.x.span();
  std::string svg;
  for (const double tick : frame.x_ticks) {
    const Vec2 at = frame({tick, frame.y.low});
    svg += svg_line("grid", at, {at.x(), frame.top});
    svg += svg_words("soft middle", {at.x(), at.y() + 18}, tick_label(tick, step));
  }
  return svg + svg_words("small middle", {frame.left + 0.5 * frame.width, plot.height - 10}, axis_words(plot.x));
}

std::string y_axis(const Plot& plot, const Frame& frame) {
  std::string svg;
  for (const double tick : frame.y_ticks) {
    const Vec2 at = frame({frame.x.low, tick});
    const bool zero = std::abs(tick) < 1e-9 * step_of(frame.y_ticks);
    svg += svg_line(zero ? "zero" : "grid", at, {frame.right(), at.y()});
    svg += svg_words("soft end", {at.x() - 7, at.y() + 4}, tick_label(zero ? 0 : tick, step_of(frame.y_ticks)));
  }
  const double middle = frame.top + 0.5 * frame.height;
  return svg + "<text class=\"small middle\" transform=\"translate(14 " + svg_number(middle) + ") rotate(-90)\">" +
         safe_text(axis_words(plot.y)) + "</text>";
}

std::string_view ink_class(Ink ink) {
  switch (ink) {
    case Ink::p1:
      return "p1";
    case Ink::p2:
      return "p2";
    case Ink::third:
      return "third";
    case Ink::main:
      break;
  }
  return "main";
}

std::string series_classes(const PlotSeries& series) {
  return "curve " + std::string(ink_class(series.ink)) + (series.thin ? " thin" : "");
}

/// Title and legend, in as many lines as they need.
struct Header {
  std::string svg;
  double extra_height = 0;  ///< beyond one line each
};

constexpr double k_line_height = 18;
constexpr double k_title_baseline = 17, k_legend_baseline = 42;  // of their first lines

std::vector<std::string> wrapped_title(const std::string& title, double width) {
  constexpr double k_heading_font = 14.5;  // semibold
  std::vector<std::string> lines{""};
  std::istringstream words(title);
  for (std::string word; words >> word;) {
    std::string& line = lines.back();
    const std::string longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && words_width(longer, k_heading_font) > width - 4)
      lines.push_back(word);
    else
      line = longer;
  }
  return lines;
}

Header make_header(const Plot& plot) {
  Header header;
  double y = k_title_baseline;
  for (const std::string& line : wrapped_title(plot.title, plot.width)) {
    header.svg += svg_words("heading", {2, y}, line);
    y += k_line_height;
  }
  header.extra_height = y - k_title_baseline - k_line_height;
  y = k_legend_baseline + header.extra_height;
  const auto named =
      std::count_if(plot.series.begin(), plot.series.end(), [](const auto& s) { return !s.name.empty(); });
  double x = 2;
  for (const PlotSeries& series : plot.series) {
    if (series.name.empty() || named < 2) continue;
    const double width = 32 + words_width(series.name, k_small_font);
    if (x > 2 && x + width > plot.width) {
      x = 2;
      y += k_line_height;
      header.extra_height += k_line_height;
    }
    header.svg += svg_line(series_classes(series), {x, y - 4}, {x + 26, y - 4});
    header.svg += svg_words("small", {x + 32, y}, series.name);
    x += width + 18;
  }
  return header;
}

/// A curve is broken where it leaves the frame above or below, as it may if the axis has a forced end.
std::string curves(const Plot& plot, const Frame& frame) {
  std::string svg;
  for (const PlotSeries& series : plot.series) {
    std::vector<Vec2> points;
    points.reserve(series.points.size());
    for (const Vec2& value : series.points) {
      Vec2 at = frame(value);
      const double margin = 0.02 * frame.height;
      if (at.y() < frame.top - margin || at.y() > frame.bottom() + margin)
        at.y() = std::numeric_limits<double>::quiet_NaN();
      points.push_back(at);
    }
    svg += "<path class=\"" + series_classes(series) + "\"";
    if (!series.name.empty()) svg += " data-series=\"" + safe_text(series.name) + "\"";
    svg += " d=\"" + path_data(points, false) + "\"/>";
  }
  return svg;
}

std::string limits(const Plot& plot, const Frame& frame) {
  std::string svg;
  for (const PlotLimit& limit : plot.limits) {
    const Vec2 at = frame({frame.x.low, limit.y});
    if (!at.allFinite() || at.y() < frame.top - 1 || at.y() > frame.bottom() + 1) continue;
    svg += svg_line("limit", at, {frame.right(), at.y()});
    const bool below = at.y() < frame.top + 16;
    svg += svg_words("limit-words halo end", {frame.right() - 4, at.y() + (below ? 14 : -5)}, limit.words);
  }
  return svg;
}

std::string marks(const Plot& plot, const Frame& frame) {
  std::string svg;
  for (const PlotMark& mark : plot.marks) {
    const Vec2 at = frame(mark.at);
    if (!at.allFinite()) continue;
    const std::string ink(ink_class(mark.ink));
    svg += svg_circle("dot " + ink, at, 3.5);
    const double width = words_width(mark.words, k_small_font);
    const bool at_right_edge = at.x() + 8 + width > frame.right();
    const bool at_top = at.y() < frame.top + 18;
    const double gap = at_top ? 12 : 7;
    svg += svg_words(at_right_edge ? "small halo end" : "small halo",
                     {at.x() + (at_right_edge ? -gap : gap), at.y() + (at_top ? 4 : -8)}, mark.words);
  }
  return svg;
}

/// Data for the read-out to convert places back into values.
std::string readout_attributes(const Plot& plot, const Frame& frame) {
  std::string values;
  for (const double value :
       {frame.left, frame.top, frame.width, frame.height, frame.x.low, frame.x.high, frame.y.low, frame.y.high}) {
    values += (values.empty() ? "" : " ") + shortest(value);
  }
  return " data-plot=\"" + values + "\" data-x=\"" + safe_text(plot.x.unit) + "\" data-y=\"" + safe_text(plot.y.unit) +
         "\"";
}

}  // namespace

std::vector<double> nice_ticks(double low, double high, int count, const std::string& unit) {
  const double rough = (high - low) / std::max(1, count);
  const double decade = elementary::pow(10.0, std::floor(elementary::log10(rough)));
  std::vector<double> steps{decade, 2 * decade, 5 * decade, 10 * decade};
  if (unit == "°" && rough > 5 && rough <= 360) steps = {10, 15, 30, 45, 90, 180, 360};
  double step = steps.back();
  for (const double candidate : steps) {
    if (candidate >= rough * (1 - 1e-9)) {
      step = candidate;
      break;
    }
  }
  // Tolerance for an end that differs from a tick by rounding only.
  const double first = std::floor(low / step + 1e-9);
  const double last = std::max(std::ceil(high / step - 1e-9), first + 1);
  std::vector<double> ticks;
  for (double k = first; k <= last; ++k) ticks.push_back(k * step);
  return ticks;
}

int tick_decimals(double step) {
  return std::clamp(static_cast<int>(-std::floor(elementary::log10(std::abs(step)) + 1e-9)), 0, 12);
}

// The height of the narrowest strip of a given slope about the points is a convex function of the slope. Its minimum is
// found by ternary search between the smallest and the largest slope of chords between neighbours.
BestLine best_line(const std::vector<Vec2>& points) {
  const auto strip = [&](double slope) {
    Range range;
    for (const Vec2& point : points) range.include(point.y() - slope * point.x());
    return range;
  };
  Range slopes;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec2 chord = points[i] - points[i - 1];
    if (chord.x() != 0) slopes.include(chord.y() / chord.x());
  }
  if (!(slopes.low <= slopes.high)) return {};
  for (int i = 0; i < 120; ++i) {
    const double third = slopes.span() / 3;
    if (strip(slopes.low + third).span() < strip(slopes.high - third).span()) {
      slopes.high -= third;
    } else {
      slopes.low += third;
    }
  }
  const double slope = 0.5 * (slopes.low + slopes.high);
  const Range range = strip(slope);
  return {slope, 0.5 * (range.low + range.high), 0.5 * range.span()};
}

namespace {

Figure laid_out(Plot plot) {
  const Header header = make_header(plot);
  plot.height += header.extra_height;
  Frame frame = make_frame(plot, header.extra_height);
  // A name of y longer than its axis would run into the legend.
  const double name_length = words_width(axis_words(plot.y), k_small_font) + 6;
  if (frame.height < name_length) {
    plot.height += name_length - frame.height;
    frame = make_frame(plot, header.extra_height);
  }
  Figure figure{plot.width, plot.height, plot.title, {}, readout_attributes(plot, frame)};
  figure.body = header.svg + x_axis(plot, frame) + y_axis(plot, frame) + limits(plot, frame) + curves(plot, frame) +
                marks(plot, frame);
  return figure;
}

/// Every second point of a dense curve, and all points beside a gap: a narrow layout has half the pixels.
std::vector<Vec2> thinner(const std::vector<Vec2>& points) {
  constexpr std::size_t k_dense = 120;
  if (points.size() < k_dense) return points;
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_inside = i > 0 && i + 1 < points.size() && points[i - 1].allFinite() && points[i].allFinite() &&
                           points[i + 1].allFinite();
    if (i % 2 == 0 || !is_inside) kept.push_back(points[i]);
  }
  return kept;
}

}  // namespace

Figure plot_figure(const Plot& plot) {
  // Width of a phone's column. The font is the same as in the wide layout.
  constexpr double k_narrow = 280;
  Figure figure = laid_out(plot);
  Plot narrow = plot;
  narrow.width = k_narrow;
  narrow.height = 0.85 * plot.height;
  for (PlotSeries& series : narrow.series) series.points = thinner(series.points);
  if (plot.width > k_narrow) figure.narrow.push_back(laid_out(std::move(narrow)));
  return figure;
}

}  // namespace fusee::formats
