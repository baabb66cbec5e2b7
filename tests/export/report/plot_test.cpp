// Line plots: ticks, the best line, and curves that can be read back as their input values.
#include "export/report/plot.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <sstream>

namespace fusee::formats {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_inf = std::numeric_limits<double>::infinity();

/// Step written as m × 10^k with 1 <= m < 10.
double mantissa(double step) { return step / std::pow(10.0, std::floor(std::log10(step) + 1e-9)); }

TEST(Ticks, CoverTheRange) {
  for (const double low : {-118.92, -1.0, -3e-7, 0.0, 14.745, 99990.0}) {
    for (const double span : {2.6e-6, 0.004, 1.0, 2.617, 238.2, 7.7e5}) {
      if (span < 1e-4 * std::abs(low)) continue;  // a double's differences are too coarse to judge
      const auto ticks = nice_ticks(low, low + span, 5);
      ASSERT_GE(ticks.size(), 2u);
      ASSERT_LE(ticks.size(), 9u);
      const double step = (ticks.back() - ticks.front()) / static_cast<double>(ticks.size() - 1);
      const double slop = 1e-6 * step;
      EXPECT_LE(ticks.front(), low + slop);
      EXPECT_GE(ticks.back(), low + span - slop);
      EXPECT_GT(ticks[1], low - slop) << "the first tick is not needed";
      EXPECT_LT(ticks[ticks.size() - 2], low + span + slop) << "the last tick is not needed";
      for (const double tick : ticks) EXPECT_NEAR(std::remainder(tick, step), 0, slop);
    }
  }
}

TEST(Ticks, StepsAreRound) {
  for (const double span : {3e-5, 0.17, 0.9, 1.0, 4.2, 33.0, 5e4}) {
    const auto ticks = nice_ticks(0, span, 6);
    const double m = mantissa(ticks[1] - ticks[0]);
    EXPECT_NEAR(std::min({std::abs(m - 1), std::abs(m - 2), std::abs(m - 5)}), 0, 1e-6) << span;
  }
}

TEST(Ticks, AnglesStepLikeAProtractor) {
  const auto ticks = nice_ticks(-118.9, 119.3, 7, "°");
  EXPECT_DOUBLE_EQ(ticks[1] - ticks[0], 45);
  const auto fine = nice_ticks(-0.4, 0.4, 5, "°");
  EXPECT_NEAR(fine[1] - fine[0], 0.2, 1e-12);
  EXPECT_LE(nice_ticks(0, 1e9, 7, "°").size(), 10u) << "a wild range must not make a million ticks";
}

TEST(Ticks, LabelsHaveTheDecimalsOfTheirStep) {
  EXPECT_EQ(tick_decimals(20), 0);
  EXPECT_EQ(tick_decimals(1), 0);
  EXPECT_EQ(tick_decimals(0.5), 1);
  EXPECT_EQ(tick_decimals(0.02), 2);
}

TEST(BestLineOf, ParabolaDeviatesByHalfItsHeight) {
  std::vector<Vec2> points;
  for (int i = -100; i <= 100; ++i) points.emplace_back(0.01 * i, 1e-4 * i * i);
  const BestLine line = best_line(points);
  EXPECT_NEAR(line.slope, 0, 1e-9);
  EXPECT_NEAR(line.offset, 0.5, 1e-9);
  EXPECT_NEAR(line.deviation, 0.5, 1e-9);
}

TEST(BestLineOf, FindsTiltAndShift) {
  std::vector<Vec2> points;
  for (int i = -50; i <= 50; ++i) points.emplace_back(i, 7 - 0.25 * i + (i % 2 == 0 ? 0.1 : -0.1));
  const BestLine line = best_line(points);
  EXPECT_NEAR(line.slope, -0.25, 1e-9);
  EXPECT_NEAR(line.offset, 7, 1e-9);
  EXPECT_NEAR(line.deviation, 0.1, 1e-9);
}

TEST(BestLineOf, AcceptsNoPoints) { EXPECT_EQ(best_line({}).deviation, 0); }

Plot sample_plot() {
  Plot plot;
  plot.title = "Radius";
  plot.x = {"pulley angle α", "°", {}, {}, 0};
  plot.y = {"r", "mm", {}, {}, 0};
  plot.series = {{"r1", Ink::p1, {{-90, 16}, {0, 17.5}, {92.3, 14.8}}, false},
                 {"r2", Ink::p2, {{-90, 15}, {92.3, 15}}, false}};
  return plot;
}

pugi::xml_document parsed(const Figure& figure) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(standalone_svg(figure).c_str())) << standalone_svg(figure);
  return document;
}

/// The values of a drawn curve, computed from data-plot as the page's read-out does (readout.js).
std::vector<Vec2> read_back(const pugi::xml_document& document, const std::string& series) {
  std::istringstream frame_text(document.child("svg").attribute("data-plot").as_string());
  double frame[8];
  for (double& value : frame) frame_text >> value;
  const auto path = document.select_node(("//path[@data-series='" + series + "']").c_str()).node();
  std::string data = path.attribute("d").as_string();
  for (char& c : data) {
    if (c == 'M' || c == 'L') c = ' ';
  }
  std::istringstream numbers(data);
  std::vector<Vec2> values;
  for (double x, y; numbers >> x >> y;) {
    values.emplace_back(frame[4] + (x - frame[0]) / frame[2] * (frame[5] - frame[4]),
                        frame[7] - (y - frame[1]) / frame[3] * (frame[7] - frame[6]));
  }
  return values;
}

TEST(PlotFigure, ValuesCanBeReadBackFromTheCurve) {
  const Plot plot = sample_plot();
  const auto document = parsed(plot_figure(plot));
  for (const PlotSeries& series : plot.series) {
    const auto values = read_back(document, series.name);
    ASSERT_EQ(values.size(), series.points.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_NEAR(values[i].x(), series.points[i].x(), 0.01);
      EXPECT_NEAR(values[i].y(), series.points[i].y(), 1e-3);
    }
  }
}

TEST(PlotFigure, NamesUnitsLimitsAndMarks) {
  Plot plot = sample_plot();
  plot.limits = {{14.5, "smallest radius"}};
  plot.marks = {{{0, 17.5}, "largest", Ink::p1}};
  const std::string svg = inline_svg(plot_figure(plot));
  for (const char* words : {"Radius", "pulley angle α (°)", "r (mm)", ">r1<", ">r2<", "smallest radius", "largest"}) {
    EXPECT_THAT(svg, HasSubstr(words));
  }
}

TEST(PlotFigure, HasNarrowLayout) {
  Plot plot = sample_plot();
  plot.title = "Radius of curvature of the pitch curves (thin: closing arc)";
  const Figure figure = plot_figure(plot);
  ASSERT_EQ(figure.narrow.size(), 1u);
  const auto document = parsed(figure.narrow.front());
  EXPECT_GE(document.select_nodes("//text[@class='heading']").size(), 2u) << "a long title takes two lines";
  for (const PlotSeries& series : plot.series) {
    const auto values = read_back(document, series.name);
    ASSERT_EQ(values.size(), series.points.size());
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i].y(), series.points[i].y(), 2e-3);
  }
}

TEST(PlotFigure, NarrowLayoutHasHalfThePoints) {
  Plot plot = sample_plot();
  plot.series.resize(1);
  plot.series[0].points.clear();
  for (int i = 0; i <= 200; ++i) plot.series[0].points.emplace_back(i, i == 101 ? k_nan : 0.01 * i * i);
  const Figure figure = plot_figure(plot);
  const auto moves = [](const Figure& layout) {
    const std::string svg = inline_svg(layout);
    const std::size_t from = svg.find("data-series=\"r1\" d=\""), to = svg.find("\"/>", from);
    return std::pair{std::count(svg.begin() + static_cast<long>(from), svg.begin() + static_cast<long>(to), 'L'),
                     std::count(svg.begin() + static_cast<long>(from), svg.begin() + static_cast<long>(to), 'M')};
  };
  Figure wide = figure;
  wide.narrow.clear();
  EXPECT_EQ(moves(wide), (std::pair<long, long>{198, 2}));
  EXPECT_EQ(moves(figure.narrow.front()), (std::pair<long, long>{99, 2}));
}

TEST(PlotFigure, LongAxisNameStaysBelowTheLegend) {
  Plot plot = sample_plot();
  plot.y.label = "measured less the declared model";
  plot.height = 200;
  const Figure figure = plot_figure(plot);
  for (const Figure* layout : {&figure, &figure.narrow.front()}) {
    const auto document = parsed(*layout);
    std::istringstream frame(document.child("svg").attribute("data-plot").as_string());
    double left = 0, top = 0, width = 0, height = 0;
    frame >> left >> top >> width >> height;
    EXPECT_GE(height, words_width("measured less the declared model (mm)", 12));
    EXPECT_LE(top + height, layout->height - 40);
  }
}

TEST(PlotFigure, InvalidNumberBreaksTheLineOnly) {
  Plot plot = sample_plot();
  plot.series[0].points = {{-90, 16}, {-45, 16}, {0, k_nan}, {45, k_inf}, {60, 15}, {92.3, 15}};
  const std::string svg = inline_svg(plot_figure(plot));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_EQ(read_back(parsed(plot_figure(plot)), "r1").size(), 4u);
}

TEST(PlotFigure, AcceptsAnyValues) {
  for (const double value : {k_nan, k_inf, -k_inf, 0.0, 1e300, -1e-300, 5.0}) {
    Plot plot = sample_plot();
    plot.series = {{"one", Ink::main, {{value, value}, {value, value}}, false}};
    plot.limits = {{value, "limit"}};
    plot.marks = {{{value, value}, "mark", Ink::main}};
    const std::string svg = inline_svg(plot_figure(plot));
    EXPECT_THAT(svg, Not(HasSubstr("nan"))) << value;
    EXPECT_THAT(svg, Not(HasSubstr("inf"))) << value;
    EXPECT_LT(svg.size(), 20000u);
  }
  EXPECT_THAT(inline_svg(plot_figure({})), HasSubstr("</svg>"));
}

TEST(PlotFigure, WordsAreEscaped) {
  Plot plot = sample_plot();
  plot.title = "<script>&\"";
  plot.series[0].name = "a<b'";
  const auto document = parsed(plot_figure(plot));
  EXPECT_STREQ(document.child("svg").child("title").text().as_string(), "<script>&\"");
  EXPECT_TRUE(document.select_nodes("//script").empty());
}

}  // namespace
}  // namespace fusee::formats
