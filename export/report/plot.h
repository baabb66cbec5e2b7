/// \file
/// Internal: line plots as plain values: title, axes with units, series, limits, marks → one figure. Independent of
/// pulleys.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "export/report/svg.h"

namespace fusee::formats {

/// A point that breaks the line.
inline constexpr double k_gap = std::numeric_limits<double>::quiet_NaN();

/// Colour and line style of a series, distinguishable in black and white and for colour-blind readers.
enum class Ink { main, p1, p2, third };

struct PlotAxis {
  std::string label;          ///< "pulley angle α"
  std::string unit;           ///< "mm", "°" … or "" for a dimensionless number
  std::optional<double> low;  ///< end of the axis; empty: the data's
  std::optional<double> high;
  double least_span = 0;  ///< least span of the axis, so that rounding noise is not magnified
};

struct PlotSeries {
  std::string name;  ///< "": no legend and no read-out
  Ink ink = Ink::main;
  std::vector<Vec2> points;  ///< a point that is not finite breaks the line
  bool thin = false;         ///< a thinner line, for a secondary curve
};

/// A horizontal line for a limit, with its label at the right end.
struct PlotLimit {
  double y = 0;
  std::string words;
};

/// A labelled point.
struct PlotMark {
  Vec2 at;
  std::string words;
  Ink ink = Ink::main;
};

struct Plot {
  std::string title;
  PlotAxis x;
  PlotAxis y;
  std::vector<PlotSeries> series;
  std::vector<PlotLimit> limits;
  std::vector<PlotMark> marks;
  double width = 460;   ///< px
  double height = 300;  ///< px
};

Figure plot_figure(const Plot& plot);

/// Evenly spaced round numbers, the first <= low and the last >= high; about `count` of them. Steps are 1, 2, 5 × 10^k.
/// For `unit` "°", steps from 5 to 360 are 5, 10, 15, 30, 45, 90, 180 or 360. Requires finite low < high.
std::vector<double> nice_ticks(double low, double high, int count, const std::string& unit = {});
/// The minimax line of the points and its deviation: |y − (offset + slope x)| <= deviation.
struct BestLine {
  double slope = 0;
  double offset = 0;
  double deviation = 0;
};
BestLine best_line(const std::vector<Vec2>& points);

/// Number of decimals for a tick label of this step.
int tick_decimals(double step);

}  // namespace fusee::formats
