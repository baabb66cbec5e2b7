// The drawn mechanism is to scale and in groups that a page can move.
#include <gmock/gmock.h>

#include <cstdio>
#include <pugixml.hpp>

#include "export/report/drawing.h"
#include "fusee/base.h"
#include "support/mechanisms.h"

namespace fusee::formats {
namespace {

TEST(MechanismFigures, AreToScale) {
  const Mechanism mechanism = testing::forearm();
  const auto figures = mechanism_figures(mechanism, profile::synthesise(mechanism), {{0, 0}});
  ASSERT_EQ(figures.size(), 1u);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(inline_svg(figures[0]).c_str()));
  const auto length_of = [](const pugi::xml_node& path) {
    Vec2 from, to;
    EXPECT_EQ(std::sscanf(path.attribute("d").as_string(), "M%lf %lfL%lf %lf", &from.x(), &from.y(), &to.x(), &to.y()),
              4);
    return (to - from).norm();
  };
  const double link = length_of(document.select_node("//g[@class='joint-link']/path").node());
  const double bar = length_of(document.select_node("/svg/path[@class='dimension']").node());
  const double bar_mm = document.select_node("/svg/text[contains(., ' mm')]").node().text().as_double();
  EXPECT_NEAR(link / bar * bar_mm, mechanism.joint.R, 0.1);
}

TEST(MechanismFigures, HaveMovableGroups) {
  const Mechanism mechanism = testing::forearm();
  const auto figures = mechanism_figures(mechanism, profile::synthesise(mechanism), {{radians(90), radians(20)}});
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(inline_svg(figures[0]).c_str()));
  EXPECT_EQ(document.select_nodes("/svg/g[@class='tendon tendon1']").size(), 1u);
  EXPECT_EQ(document.select_nodes("/svg/g[@class='tendon tendon2']").size(), 1u);
  const std::string turn = document.select_node("/svg/g[@class='pulley']").node().attribute("transform").as_string();
  EXPECT_EQ(turn.rfind("rotate(90 ", 0), 0u) << "α > 0 is clockwise, as SVG turns: " << turn;
}

TEST(DimensionFigure, NamesEachLengthInsideItsFrame) {
  const auto names_in = [](const Mechanism& mechanism) {
    const auto figure = dimension_figure(mechanism, profile::synthesise(mechanism));
    std::vector<std::string> names;
    if (!figure) return names;
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(inline_svg(*figure).c_str()));
    for (const auto& words : document.select_nodes("//text")) {
      const double x = words.node().attribute("x").as_double(), y = words.node().attribute("y").as_double();
      // A name begins inside the figure, with space for its letters: px.
      EXPECT_TRUE(x >= 10 && x <= figure->width - 20 && y >= 10 && y <= figure->height - 5) << x << " " << y;
      names.emplace_back(words.node().text().as_string());
    }
    return names;
  };
  EXPECT_THAT(names_in(testing::forearm()), ::testing::IsSupersetOf({"R", "EB", "ED", "OE", "EF", "r1", "C", "G"}));
  Mechanism bare;
  EXPECT_FALSE(dimension_figure(bare, profile::SynthesisResult()));
}

TEST(MovingFigures, GiveTheirScaleAndOrigin) {
  const Mechanism mechanism = testing::forearm();
  const auto figures = moving_figures(mechanism, profile::synthesise(mechanism));
  ASSERT_EQ(figures.size(), 2u);
  for (const Figure& figure : figures) {
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(inline_svg(figure).c_str()));
    const auto scene = document.select_node("/svg/g[@class='scene']").node();
    // data-view: px per mm, and the place of the joint axis O, px. The link is drawn from O to C, straight up at home.
    double scale = 0, x = 0, y = 0, to_x = 0, to_y = 0;
    ASSERT_EQ(std::sscanf(scene.attribute("data-view").as_string(), "%lf %lf %lf", &scale, &x, &y), 3);
    const char* link = scene.select_node("./g[@class='joint-link']/path").node().attribute("d").as_string();
    ASSERT_EQ(std::sscanf(link, "M%*f %*fL%lf %lf", &to_x, &to_y), 2);
    EXPECT_NEAR(to_x, x, 0.01);
    EXPECT_NEAR(to_y, y - scale * mechanism.joint.R, 0.01);
  }
}

TEST(PolarFigure, ReportsErrorOfPolarDrawing) {
  const Mechanism mechanism = testing::forearm();
  const profile::SynthesisResult synthesis = profile::synthesise(mechanism);
  EXPECT_FALSE(polar_figure(synthesis, transmission::Side::left)) << "P1 is round: both drawings are equal";
  const auto figure = polar_figure(synthesis, transmission::Side::right);
  ASSERT_TRUE(figure);
  double stated = 0;
  const std::size_t at = figure->body.find(" mm apart at ");
  ASSERT_NE(at, std::string::npos);
  const std::size_t begin = figure->body.rfind('>', at) + 1;
  std::string words = figure->body.substr(begin, at - begin);
  if (words.rfind("\u2212", 0) == 0) words = "-" + words.substr(std::string("\u2212").size());
  ASSERT_EQ(std::sscanf(words.c_str(), "%lf", &stated), 1);
  // The exact profile's radius where the tendon leaves, √(r2² + r2'²), exceeds r2, the tendon's distance from the axis.
  // That difference gives the order of the error.
  double most = 0;
  for (const transmission::TransmissionPoint& point : synthesis.stroke)
    most = std::max(most, std::hypot(point.t2.p, point.t2.dp) - point.t2.p);
  EXPECT_GT(std::abs(stated), 0.2 * most);
  EXPECT_LT(std::abs(stated), 20 * most);
}

TEST(Thinned, StaysWithinItsTolerance) {
  std::vector<Vec2> circle;
  for (int i = 0; i <= 2000; ++i) circle.push_back(100 * unit(k_two_pi * i / 2000));
  const auto few = thinned(circle, 0.1);
  EXPECT_LT(few.size(), 200u);
  EXPECT_EQ(few.front(), circle.front());
  EXPECT_EQ(few.back(), circle.back());
  for (std::size_t i = 1; i < few.size(); ++i) EXPECT_GT((0.5 * (few[i] + few[i - 1])).norm(), 99.9);
}

}  // namespace
}  // namespace fusee::formats
