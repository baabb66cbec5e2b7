// Each check of a drawing passes on a good one and fails on a damaged one.
#include <gmock/gmock.h>

#include "drawing_tools.h"
#include "export/drawings/dxf_writer.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

using testing::check_named;
using ::testing::ElementsAre;
using testing::failed;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

DrawingPath contour(const std::string& layer, Polygon points, bool closed = true, int line = 7) {
  return {layer, "LWPOLYLINE", line, closed, std::move(points)};
}

Polygon square(double x, double y, double size) { return rectangle({x, y}, {x + size, y + size}); }

/// A plate with a hole and a number.
Drawing plate() {
  Drawing drawing;
  drawing.paths = {contour("ENGRAVE", {{20, 20}, {22, 24}, {24, 20}}, false),
                   contour("CUT_INNER", circle_polygon({10, 10}, 3)), contour("CUT_OUTER", square(0, 0, 30)),
                   contour("SHEET", rectangle({-5, -5}, {100, 100}))};
  return drawing;
}

TEST(CheckDrawing, AcceptsGoodDrawing) { EXPECT_THAT(failed(check_drawing(plate())), IsEmpty()); }

TEST(CheckDrawing, RejectsEmptyDrawing) { EXPECT_THAT(failed(check_drawing({})), ElementsAre("contours")); }

TEST(CheckDrawing, RejectsOpenContour) {
  Drawing drawing = plate();
  drawing.paths[2].closed = false;
  const auto checks = check_drawing(drawing);
  EXPECT_THAT(failed(checks), ElementsAre("contours_closed"));
  EXPECT_THAT(check_named(checks, "contours_closed").where, HasSubstr("layer CUT_OUTER, LWPOLYLINE at line 7"));
}

TEST(CheckDrawing, RejectsEndsThatAlmostMeet) {
  Drawing drawing = plate();
  drawing.paths[2] = contour("CUT_OUTER", {{0, 0}, {30, 0}, {30, 30}, {0, 30}, {0, 0.01}}, false);
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("ends_meet"));
  EXPECT_NEAR(check_named(check_drawing(drawing), "ends_meet").value, 0.01, 1e-12);
}

// A last line that overshoots the first one has one fault, not two.
TEST(CheckDrawing, ReportsOvershootOnce) {
  Drawing drawing = plate();
  drawing.paths[2] = contour("CUT_OUTER", {{0, 0}, {30, 0}, {30, 30}, {0, 30}, {0, -0.01}}, false);
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("ends_meet"));
  drawing.paths[2].points = {{0, 0}, {30, 0}, {30, 30}, {15, -1}, {0, 30}, {0, 0.01}};
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("ends_meet", "no_self_crossing", "nothing_outside"));
}

// The ends of a short line are close, but it was never meant to be closed.
TEST(CheckDrawing, ShortLineIsOpen) {
  Drawing drawing = plate();
  drawing.paths.push_back(contour("CUT_OUTER", {{40, 40}, {40.5, 40}}, false));
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("contours_closed"));
}

TEST(CheckDrawing, ReportsSingleOpenContourOnce) {
  Drawing drawing;
  drawing.paths = {contour("0", {{0, 0}, {30, 0}, {30, 30}, {0, 30}, {0, 0.05}}, false)};
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("ends_meet"));
}

TEST(CheckDrawing, ReportsLineOnEdgeAsDuplicateOnly) {
  Drawing drawing = plate();
  drawing.paths.push_back(contour("CUT_OUTER", {{0, 0}, {30, 0}}, false));
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("no_duplicate_lines"));
}

TEST(CheckDrawing, ReportsOmittedEntityAndChecksOthers) {
  Drawing drawing = plate();
  drawing.undrawn = 2;
  drawing.first_undrawn = {36, "the radius of this ARC is -1"};
  const auto checks = check_drawing(drawing);
  EXPECT_THAT(failed(checks), ElementsAre("undrawn_entities"));
  EXPECT_EQ(check_named(checks, "undrawn_entities").where, "line 36: the radius of this ARC is -1");
  drawing.paths.clear();
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("undrawn_entities"));
}

TEST(CheckDrawing, CircleWidthIsItsDiameter) {
  Drawing drawing = plate();
  drawing.paths[1] = contour("CUT_INNER", circle_polygon({10, 10}, 0.5));
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("smallest_feature"));
  drawing.paths[1].diameter = 1;
  EXPECT_THAT(failed(check_drawing(drawing)), IsEmpty());
  EXPECT_EQ(check_named(check_drawing(drawing), "smallest_feature").value, 1);
}

TEST(CheckDrawing, EngravingMayEndAndCross) {
  Drawing drawing = plate();
  drawing.paths.push_back(contour("ENGRAVE", {{20, 22}, {26, 22}, {22, 20}, {22, 28}}, false));
  EXPECT_THAT(failed(check_drawing(drawing)), IsEmpty());
}

TEST(CheckDrawing, RejectsDuplicateContour) {
  Drawing drawing = plate();
  DrawingPath again = drawing.paths[2];
  std::reverse(again.points.begin(), again.points.end());
  drawing.paths.push_back(again);
  const auto checks = check_drawing(drawing);
  EXPECT_THAT(failed(checks), ElementsAre("no_duplicate_lines"));
  EXPECT_EQ(check_named(checks, "no_duplicate_lines").value, 4);
}

TEST(CheckDrawing, RejectsFigureOfEight) {
  Drawing drawing = plate();
  drawing.paths[2].points = {{0, 0}, {30, 30}, {30, 0}, {0, 30}};
  const Check check = check_named(check_drawing(drawing), "no_self_crossing");
  EXPECT_FALSE(check.ok);
  EXPECT_THAT(check.where, HasSubstr("(15, 15)"));
}

// A pentagram turns to one side at every corner, as a convex outline does, but twice round.
TEST(CheckDrawing, RejectsPentagram) {
  Drawing drawing = plate();
  drawing.paths[2].points.clear();
  for (int i = 0; i < 5; ++i) drawing.paths[2].points.push_back(Vec2(15, 15) + 15 * unit(0.8 * k_pi * i));
  EXPECT_FALSE(check_named(check_drawing(drawing), "no_self_crossing").ok);
}

// The box of an L contains a square, which meets the L only in the second case.
TEST(CheckDrawing, ComparesContoursWithOverlappingBoxes) {
  Drawing drawing = plate();
  drawing.paths[2].points = {{0, 0}, {30, 0}, {30, 5}, {5, 5}, {5, 30}, {0, 30}};
  drawing.paths[1].points = circle_polygon({2.5, 2.5}, 1.5);
  drawing.paths.push_back(contour("CUT_OUTER", square(10, 10, 8), true, 99));
  EXPECT_TRUE(check_named(check_drawing(drawing), "no_crossing_contours").ok);
  drawing.paths.back().points = square(4, 4, 8);
  EXPECT_FALSE(check_named(check_drawing(drawing), "no_crossing_contours").ok);
}

TEST(CheckDrawing, RejectsSelfTouchingContour) {
  Drawing drawing = plate();
  drawing.paths[2].points = {{0, 0}, {30, 0}, {30, 30}, {15, 0}, {0, 30}};
  EXPECT_FALSE(check_named(check_drawing(drawing), "no_self_crossing").ok);
}

TEST(CheckDrawing, RejectsContourFoldedBack) {
  Drawing drawing = plate();
  drawing.paths[2].points = {{0, 0}, {30, 0}, {40, 0}, {30, 0}, {30, 30}, {0, 30}};
  EXPECT_FALSE(check_named(check_drawing(drawing), "no_self_crossing").ok);
}

TEST(CheckDrawing, RejectsCrossingContours) {
  Drawing drawing = plate();
  drawing.paths.push_back(contour("CUT_OUTER", square(20, 20, 40), true, 99));
  const auto checks = check_drawing(drawing);
  EXPECT_THAT(failed(checks), ElementsAre("no_crossing_contours"));
  EXPECT_THAT(check_named(checks, "no_crossing_contours").where, HasSubstr("line 99"));
}

TEST(CheckDrawing, RejectsNarrowSlot) {
  Drawing drawing = plate();
  // 0.7 mm wide and oblique, so that its box is large.
  const Vec2 along = unit(0.5), across = turned_left(along);
  drawing.paths[1].points = {Vec2(10, 10), Vec2(10, 10) + 8 * along, Vec2(10, 10) + 8 * along + 0.7 * across,
                             Vec2(10, 10) + 0.7 * across};
  const Check check = check_named(check_drawing(drawing), "smallest_feature");
  EXPECT_FALSE(check.ok);
  EXPECT_NEAR(check.value, 0.7, 1e-12);
}

// Every design with a bore below 1 mm failed this check (campaign of seed 330001, design 9).
TEST(CheckDrawing, AcceptsNarrowBore) {
  Drawing drawing;
  drawing.paths = {contour("P1_FLOOR", circle_polygon({0, 0}, 10), true, 1),
                   contour("BORE", circle_polygon({0, 0}, 0.4), true, 2)};
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre());
  drawing.paths[1].layer = "CUT_INNER";
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("smallest_feature"));
}

TEST(CheckDrawing, RejectsHoleOutsidePlate) {
  Drawing drawing = plate();
  drawing.paths[1].points = circle_polygon({35, 10}, 3);
  const auto checks = check_drawing(drawing);
  EXPECT_THAT(failed(checks), ElementsAre("nothing_outside"));
  EXPECT_THAT(check_named(checks, "nothing_outside").where, HasSubstr("not inside CUT_OUTER: layer CUT_INNER"));
}

TEST(CheckDrawing, RejectsPlateBeyondSheet) {
  Drawing drawing = plate();
  drawing.paths[3].points = square(0, 0, 29);
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("nothing_outside"));
}

TEST(CheckDrawing, RejectsCheckSquareBesideSheet) {
  Drawing drawing = plate();
  drawing.paths.push_back(contour("CHECK_10MM", square(0, -15, 10), true, 5));
  EXPECT_THAT(check_named(check_drawing(drawing), "nothing_outside").where, HasSubstr("not inside SHEET: layer CHECK"));
}

TEST(CheckDrawing, ForeignDrawingsHaveContoursOnEveryLayer) {
  Drawing drawing;
  drawing.paths = {contour("Layer 1", square(0, 0, 30)), contour("whatever", {{1, 1}, {5, 5}}, false)};
  EXPECT_THAT(failed(check_drawing(drawing)), ElementsAre("contours_closed"));
}

// The sweep compared with a test of every pair, on polygons that cross often, sometimes or never.
TEST(CheckDrawing, SweepAgreesWithAllPairs) {
  std::uint32_t state = 1;
  const auto random = [&state](int most) {
    return static_cast<int>((state = state * 1664525u + 1013904223u) >> 8) % most;
  };
  int crossing = 0;
  for (int round = 0; round < 2000; ++round) {
    Polygon points;
    const int corners = 3 + random(5);
    for (int k = 0; k < corners; ++k) {
      // On a small grid vertical edges, shared points and overlaps are common.
      const Vec2 p(random(6), random(6));
      if (points.empty() || p != points.back()) points.push_back(p);
    }
    if (points.size() > 1 && points.front() == points.back()) points.pop_back();
    if (points.size() < 3) continue;
    bool expected = false;
    const std::size_t n = points.size();
    const auto on = [](const Vec2& a, const Vec2& b, const Vec2& p) {
      return cross(b - a, p - a) == 0 && (p - a).dot(p - b) <= 0;
    };
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        const Vec2 &a = points[i], &b = points[(i + 1) % n], &c = points[j], &d = points[(j + 1) % n];
        if (j == i + 1) {
          expected |= on(a, b, d) || on(c, d, a);
        } else if ((j + 1) % n == i) {
          expected |= on(a, b, c) || on(c, d, b);
        } else {
          const bool proper =
              cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
          expected |= proper || on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b);
        }
      }
    }
    Drawing drawing;
    drawing.paths = {contour("cut", points)};
    EXPECT_EQ(!check_named(check_drawing(drawing), "no_self_crossing").ok, expected) << "round " << round;
    crossing += expected;
  }
  EXPECT_GT(crossing, 100);
  EXPECT_LT(crossing, 1900);
}

TEST(CheckDrawing, HandlesHundredThousandLines) {
  Drawing drawing;
  Polygon comb;  // long diagonal teeth: every box overlaps every other
  for (int k = 0; k < 50000; ++k) {
    comb.emplace_back(k * 0.01, 0);
    comb.emplace_back(1000 + k * 0.01, 1000);
    if (k % 2) std::swap(comb[comb.size() - 1], comb[comb.size() - 2]);
  }
  drawing.paths = {contour("cut", comb, false)};
  EXPECT_TRUE(check_named(check_drawing(drawing), "no_self_crossing").ok);
}

}  // namespace
}  // namespace fusee::formats
