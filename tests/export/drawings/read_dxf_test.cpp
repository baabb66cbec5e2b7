// Reads drawings of any origin: points in mm, joined chains, and a line number in every error.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "drawing_tools.h"
#include "export/drawings/dxf_writer.h"
#include "export/drawings/plane_shapes.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

using testing::dxf_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::tags;

std::string line(double x1, double y1, double x2, double y2, const std::string& layer = "cut") {
  const auto text = [](double v) { return std::to_string(v); };
  return tags({{0, "LINE"}, {8, layer}, {10, text(x1)}, {20, text(y1)}, {11, text(x2)}, {21, text(y2)}});
}

Drawing read(const std::string& bytes) { return read_dxf(bytes, "test.dxf"); }

/// The one path of a drawing.
DrawingPath only_path(const std::string& entities, const std::string& blocks = {}, int units = 4) {
  const Drawing drawing = read(dxf_of(entities, units, blocks));
  EXPECT_EQ(drawing.paths.size(), 1u);
  return drawing.paths.empty() ? DrawingPath{} : drawing.paths.front();
}

double worst_distance_from_circle(const Polygon& points, const Vec2& centre, double radius) {
  double worst = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    worst = std::max(worst, std::abs((points[i] - centre).norm() - radius));
    worst = std::max(worst, std::abs((0.5 * (points[i] + points[i + 1]) - centre).norm() - radius));
  }
  return worst;
}

std::string message_of(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const InputError& error) {
    return to_text(error.diagnostics().front());
  }
  return "no error";
}

TEST(ReadDxf, JoinsLinesToLoop) {
  // In any order and direction.
  const DrawingPath path = only_path(line(0, 0, 10, 0) + line(10, 10, 10, 0) + line(0, 10, 0, 0) + line(0, 10, 10, 10));
  EXPECT_TRUE(path.closed);
  EXPECT_EQ(path.points.size(), 4u);
  EXPECT_DOUBLE_EQ(std::abs(signed_area(path.points)), 100.0);
}

TEST(ReadDxf, JoinsEndsWithinTolerance) {
  EXPECT_TRUE(only_path(line(0, 0, 10, 0) + line(10, 0.00005, 5, 5) + line(5, 5, 0, 0)).closed);
  EXPECT_FALSE(only_path(line(0, 0, 10, 0) + line(10, 0.0003, 5, 5) + line(5, 5, 0, 0)).closed);
}

// A line drawn twice does not open the loop that it belongs to.
TEST(ReadDxf, DoesNotJoinRepeatedLine) {
  const std::string square = line(0, 0, 10, 0) + line(10, 0, 10, 10) + line(10, 10, 0, 10) + line(0, 10, 0, 0);
  for (const std::string& again : {line(0, 0, 10, 0), line(10, 0, 0, 0), square}) {
    const Drawing drawing = read(dxf_of(square + again));
    EXPECT_TRUE(drawing.paths.front().closed);
    std::vector<std::string> failed;
    for (const Check& check : check_drawing(drawing))
      if (!check.ok) failed.push_back(check.name);
    EXPECT_THAT(failed, ElementsAre("no_duplicate_lines")) << again;
  }
}

TEST(ReadDxf, SeparatesLayers) {
  EXPECT_EQ(read(dxf_of(line(0, 0, 1, 0, "a") + line(1, 0, 2, 0, "b"))).paths.size(), 2u);
}

TEST(ReadDxf, DoesNotJoinThreeEnds) {
  EXPECT_EQ(read(dxf_of(line(0, 0, 1, 0) + line(0, 0, 0, 1) + line(0, 0, -1, 0))).paths.size(), 3u);
}

TEST(ReadDxf, CirclesAndArcsStayWithinAMicron) {
  const DrawingPath circle = only_path(tags({{0, "CIRCLE"}, {8, "cut"}, {10, "3"}, {20, "4"}, {40, "25"}}));
  EXPECT_TRUE(circle.closed);
  EXPECT_LE(worst_distance_from_circle(circle.points, {3, 4}, 25), 0.00101);

  const DrawingPath arc =
      only_path(tags({{0, "ARC"}, {8, "cut"}, {10, "0"}, {20, "0"}, {40, "10"}, {50, "350"}, {51, "100"}}));
  EXPECT_FALSE(arc.closed);
  EXPECT_LE(worst_distance_from_circle(arc.points, {0, 0}, 10), 0.00101);
  EXPECT_NEAR((arc.points.front() - 10 * unit(radians(350))).norm(), 0, 1e-12);
  EXPECT_NEAR((arc.points.back() - 10 * unit(radians(100))).norm(), 0, 1e-12);
  EXPECT_GT(cross(arc.points[0], arc.points[1]), 0) << "arcs run counter-clockwise";
}

TEST(ReadDxf, MirrorsArcDrawnFromBelow) {
  const DrawingPath arc = only_path(tags({{0, "ARC"},
                                          {8, "cut"},
                                          {10, "1"},
                                          {20, "0"},
                                          {40, "1"},
                                          {50, "0"},
                                          {51, "90"},
                                          {210, "0"},
                                          {220, "0"},
                                          {230, "-1"}}));
  EXPECT_NEAR((arc.points.front() - Vec2(-2, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((arc.points.back() - Vec2(-1, 1)).norm(), 0, 1e-12);
}

TEST(ReadDxf, RecognisesCircleOfTwoBulges) {
  const DrawingPath path = only_path(tags({{0, "LWPOLYLINE"},
                                           {8, "cut"},
                                           {90, "2"},
                                           {70, "1"},
                                           {10, "-5"},
                                           {20, "0"},
                                           {42, "1"},
                                           {10, "5"},
                                           {20, "0"},
                                           {42, "1"}}));
  EXPECT_TRUE(path.closed);
  EXPECT_LE(worst_distance_from_circle(path.points, {0, 0}, 5), 0.00101);
  EXPECT_NEAR(signed_area(path.points), k_pi * 25, 0.02) << "a positive bulge turns left";
}

TEST(ReadDxf, ReadsBulgesOfOldPolyline) {
  const std::string vertex = tags({{0, "VERTEX"}, {8, "cut"}});
  const DrawingPath path = only_path(tags({{0, "POLYLINE"}, {8, "cut"}, {66, "1"}, {70, "1"}}) + vertex +
                                     tags({{10, "-5"}, {20, "0"}, {42, "-1"}}) + vertex +
                                     tags({{10, "5"}, {20, "0"}, {42, "-1"}, {0, "SEQEND"}, {8, "cut"}}));
  EXPECT_EQ(path.entity, "POLYLINE");
  EXPECT_NEAR(signed_area(path.points), -k_pi * 25, 0.02);
}

TEST(ReadDxf, EllipseHasItsArea) {
  const DrawingPath path = only_path(tags({{0, "ELLIPSE"},
                                           {8, "cut"},
                                           {10, "0"},
                                           {20, "0"},
                                           {11, "0"},
                                           {21, "10"},
                                           {40, "0.5"},
                                           {41, "0"},
                                           {42, "6.283185307179586"}}));
  EXPECT_TRUE(path.closed);
  EXPECT_NEAR(signed_area(path.points), k_pi * 50, 0.05);
}

TEST(ReadDxf, RationalSplineDrawsQuarterCircle) {
  const std::string root = "0.70710678118654752";
  const DrawingPath path = only_path(tags({{0, "SPLINE"},
                                           {8, "cut"},
                                           {71, "2"},
                                           {40, "0"},
                                           {40, "0"},
                                           {40, "0"},
                                           {40, "1"},
                                           {40, "1"},
                                           {40, "1"},
                                           {41, "1"},
                                           {41, root},
                                           {41, "1"},
                                           {10, "7"},
                                           {20, "0"},
                                           {10, "7"},
                                           {20, "7"},
                                           {10, "0"},
                                           {20, "7"}}));
  EXPECT_LE(worst_distance_from_circle(path.points, {0, 0}, 7), 0.0011);
  EXPECT_NEAR((path.points.back() - Vec2(0, 7)).norm(), 0, 1e-12);
}

TEST(ReadDxf, BlocksArePlacedTurnedAndRepeated) {
  const std::string block =
      tags({{0, "BLOCK"}, {8, "0"}, {2, "hole"}, {10, "1"}, {20, "0"}}) + line(1, 0, 3, 0, "0") + tags({{0, "ENDBLK"}});
  const std::string insert = tags({{0, "INSERT"},
                                   {8, "cut"},
                                   {2, "hole"},
                                   {10, "100"},
                                   {20, "50"},
                                   {41, "2"},
                                   {42, "2"},
                                   {50, "90"},
                                   {71, "2"},
                                   {45, "10"}});
  const Drawing drawing = read(dxf_of(insert, 4, block));
  ASSERT_EQ(drawing.paths.size(), 2u);
  EXPECT_EQ(drawing.paths[0].layer, "cut") << "layer 0 in a block is the insert's";
  EXPECT_NEAR((drawing.paths[0].points[0] - Vec2(100, 50)).norm(), 0, 1e-12);
  EXPECT_NEAR((drawing.paths[0].points[1] - Vec2(100, 54)).norm(), 0, 1e-12);
  EXPECT_NEAR((drawing.paths[1].points[0] - Vec2(90, 50)).norm(), 0, 1e-12);
}

TEST(ReadDxf, UnitsBecomeMillimetres) {
  constexpr int k_no_unit = 0, k_inch = 1, k_millimetre = 4, k_centimetre = 5;  // values of $INSUNITS
  EXPECT_NEAR(only_path(line(0, 0, 1, 0), {}, k_inch).points[1].x(), 25.4, 1e-12);
  EXPECT_NEAR(only_path(line(0, 0, 1, 0), {}, k_centimetre).points[1].x(), 10, 1e-12);
  EXPECT_TRUE(read(dxf_of(line(0, 0, 1, 0), k_millimetre)).millimetres);
  EXPECT_FALSE(read(dxf_of(line(0, 0, 1, 0), k_no_unit)).millimetres);
}

TEST(ReadDxf, ListsIgnoredEntities) {
  const Drawing drawing = read(dxf_of(
      tags({{0, "TEXT"}, {8, "x"}, {1, "hello"}, {0, "HATCH"}, {8, "x"}, {0, "TEXT"}, {8, "x"}}) + line(0, 0, 1, 0)));
  EXPECT_THAT(drawing.ignored, ElementsAre("HATCH", "TEXT"));
}

TEST(ReadDxf, PathsKnowTheirLine) { EXPECT_EQ(read(dxf_of(line(0, 0, 1, 0))).paths.front().line, 26); }

TEST(ReadDxf, WrittenPointsComeBack) {
  DxfDocument document;
  document.layers = {{"CUT_OUTER", 1, true}};
  const Polygon outline = {{0.123456789123, -1e-12}, {1e5 + 1.0 / 3, 2}, {7, 1000.0 / 7}};
  document.add_closed("CUT_OUTER", outline);
  document.add_open("CUT_OUTER", {{-3, -4}, {-5, -6.5}});
  for (const DxfVersion version : {DxfVersion::ac1015, DxfVersion::r12}) {
    const Drawing drawing = read(dxf_text(document, version));
    EXPECT_EQ(drawing.version, version == DxfVersion::r12 ? "AC1009" : "AC1015");
    EXPECT_TRUE(drawing.millimetres);
    ASSERT_EQ(drawing.paths.size(), 2u);
    EXPECT_TRUE(drawing.paths[0].closed);
    EXPECT_FALSE(drawing.paths[1].closed);
    for (std::size_t i = 0; i < outline.size(); ++i) EXPECT_LE((drawing.paths[0].points[i] - outline[i]).norm(), 1e-9);
  }
}

// ---- Refusals -------------------------------------------------------------------------------------------------------

TEST(ReadDxf, ErrorsNameTheLine) {
  EXPECT_THAT(message_of(dxf_of("LINE\n0\n")), HasSubstr("test.dxf:25: error: a group code"));
}

// Other entities are read, and the entity is counted with its line and the reason.
TEST(ReadDxf, OmitsInvalidEntity) {
  const auto why = [](const std::string& entity) {
    const Drawing drawing = read(dxf_of(entity + line(0, 0, 1, 0)));
    EXPECT_EQ(drawing.paths.size(), 1u) << entity;
    EXPECT_EQ(drawing.undrawn, 1u) << entity;
    return std::to_string(drawing.first_undrawn.line) + ": " + drawing.first_undrawn.why;
  };
  EXPECT_EQ(why(tags({{0, "LINE"}, {8, "cut"}, {10, "zero"}})),
            "30: a number should stand here (group 10), not 'zero'");
  EXPECT_THAT(why(tags({{0, "LINE"}, {8, "cut"}, {10, "nan"}, {20, "inf"}})), HasSubstr("30: "));
  EXPECT_THAT(why(tags({{0, "CIRCLE"}, {8, "cut"}, {40, "-1"}})), HasSubstr("26: the radius of this CIRCLE is -1"));
  EXPECT_THAT(why(tags({{0, "INSERT"}, {2, "gone"}})), HasSubstr("block 'gone'"));
  EXPECT_THAT(why(line(0, 0, 1e9, 0)), HasSubstr("further than 10 km"));
  EXPECT_THAT(why(tags({{0, "SPLINE"}, {8, "cut"}, {71, "3"}, {40, "0"}, {10, "0"}, {20, "0"}})), HasSubstr("knots"));
  EXPECT_THAT(why(tags({{0, "ELLIPSE"}, {8, "cut"}, {11, "1e12"}, {21, "0"}, {40, "1"}})), HasSubstr("axes"));
}

TEST(ReadDxf, ReadsNumberBelowTheSmallestAsZero) {
  const auto at = [](const std::string& x) {
    return dxf_of(tags({{0, "LINE"}, {8, "cut"}, {10, x}, {20, "0"}, {11, "5"}, {21, "0"}}) + line(0, 5, 1, 5));
  };
  const std::string zeros(400, '0');
  for (const std::string& x :
       {std::string("1e-400"), std::string("1E-400"), std::string("-1.5E-400"), "." + zeros + "1",
        "0." + zeros + "1E+2", "1" + zeros + "E-999", std::string("1E-99999999999999999999")}) {
    const Drawing drawing = read(at(x));
    ASSERT_EQ(drawing.paths.size(), 2u) << x;
    EXPECT_EQ(drawing.paths[0].points[0], Vec2(0, 0)) << x;
  }
  for (const std::string& x :
       {std::string("1E400"), std::string("1e+400"), std::string("1E-400mm"), std::string("1E-400e-1"), "1" + zeros,
        "1" + zeros + "0e-50", std::string("1E99999999999999999999")}) {
    const Drawing drawing = read(at(x));
    EXPECT_EQ(drawing.paths.size(), 1u) << x;
    EXPECT_THAT(drawing.first_undrawn.why, HasSubstr("a number should stand here (group 10)")) << x;
  }
}

TEST(ReadDxf, RemarksOnEntityOfNoSize) {
  const Drawing drawing = read(dxf_of(tags({{0, "ARC"}, {8, "cut"}, {40, "0"}}) + line(3, 3, 3, 3) + line(4, 4, 4, 4) +
                                      tags({{0, "ELLIPSE"}, {8, "cut"}, {11, "0"}, {21, "0"}}) + line(0, 0, 1, 0)));
  EXPECT_EQ(drawing.paths.size(), 1u);
  EXPECT_EQ(drawing.undrawn, 0u);
  ASSERT_EQ(drawing.remarks.size(), 3u);
  EXPECT_EQ(drawing.remarks[0].text, "this ARC draws nothing: its radius is 0");
  EXPECT_EQ(drawing.remarks[0].line, 26);
  EXPECT_EQ(drawing.remarks[1].text, "this LINE draws nothing: it has no length");
  EXPECT_EQ(drawing.remarks[1].count, 2u);
}

TEST(ReadDxf, AcceptsEllipseRatioAboveOne) {
  const auto ellipse = [](const std::string& ratio) {
    return read(dxf_of(tags({{0, "ELLIPSE"},
                             {8, "cut"},
                             {10, "0"},
                             {20, "0"},
                             {11, "10"},
                             {21, "0"},
                             {40, ratio},
                             {41, "0"},
                             {42, "6.283185307179586"}})));
  };
  const Drawing tall = ellipse("1.5");
  ASSERT_EQ(tall.paths.size(), 1u);
  EXPECT_EQ(bounding_box(tall.paths[0].points).size(), Vec2(20, 30));
  ASSERT_EQ(tall.remarks.size(), 1u);
  EXPECT_THAT(tall.remarks[0].text, HasSubstr("ELLIPSE is 1.5, above 1"));
  // A ratio above 1 by rounding counts as 1.
  EXPECT_TRUE(ellipse("1.0000001").remarks.empty());
}

// CIRCLE, ARC, bulge and ELLIPSE have the size of the curve, not of its chords.
TEST(ReadDxf, CurvesHaveExactExtents) {
  const auto size = [](const std::string& entity) { return bounding_box(only_path(entity).points).size(); };
  EXPECT_EQ(size(tags({{0, "CIRCLE"}, {8, "cut"}, {40, "50"}})), Vec2(100, 100));
  EXPECT_EQ(size(tags({{0, "CIRCLE"}, {8, "cut"}, {40, "3"}})), Vec2(6, 6));
  EXPECT_LE(
      (size(tags({{0, "ARC"}, {8, "cut"}, {40, "10"}, {50, "30"}, {51, "150"}})) - Vec2(20 * std::cos(radians(30)), 5))
          .norm(),
      1e-12);
  // A slot of 60 by 10, and a half circle that bulges to its left.
  EXPECT_EQ(size(tags({{0, "LWPOLYLINE"},
                       {8, "cut"},
                       {90, "4"},
                       {70, "1"},
                       {10, "0"},
                       {20, "0"},
                       {10, "50"},
                       {20, "0"},
                       {42, "1"},
                       {10, "50"},
                       {20, "10"},
                       {10, "0"},
                       {20, "10"},
                       {42, "1"}})),
            Vec2(60, 10));
  EXPECT_EQ(
      size(tags({{0, "LWPOLYLINE"}, {8, "cut"}, {90, "2"}, {10, "0"}, {20, "0"}, {42, "-1"}, {10, "20"}, {20, "0"}})),
      Vec2(20, 10));
  // Turned by 30° in a block and stretched there: an ellipse with extremes different from the circle's.
  const std::string block = tags({{0, "BLOCK"}, {2, "b"}, {0, "CIRCLE"}, {8, "0"}, {40, "5"}, {0, "ENDBLK"}});
  const DrawingPath stretched = only_path(tags({{0, "INSERT"}, {2, "b"}, {41, "2"}, {50, "30"}}), block);
  const double c = std::cos(radians(30)), s = 0.5;
  EXPECT_LE((bounding_box(stretched.points).size() - Vec2(10 * std::hypot(2 * c, s), 10 * std::hypot(2 * s, c))).norm(),
            1e-12);
  EXPECT_FALSE(stretched.diameter);
  EXPECT_DOUBLE_EQ(*only_path(tags({{0, "INSERT"}, {2, "b"}, {41, "2"}, {42, "2"}, {50, "30"}}), block).diameter, 20);
}

TEST(ReadDxf, LinesMayEndWithCarriageReturnsAlone) {
  std::string bytes = dxf_of(line(0, 0, 10, 0) + line(10, 10, 10, 0) + line(0, 10, 0, 0) + line(0, 10, 10, 10));
  std::replace(bytes.begin(), bytes.end(), '\n', '\r');
  const Drawing drawing = read(bytes);
  ASSERT_EQ(drawing.paths.size(), 1u);
  EXPECT_TRUE(drawing.paths[0].closed);
}

// dxflib 2.0 continues its header after the header's end.
TEST(ReadDxf, SkipsValuesBetweenSections) {
  std::string bytes = dxf_of(line(0, 0, 1, 0));
  const std::string first_end = tags({{0, "ENDSEC"}});
  bytes.insert(bytes.find(first_end) + first_end.size(), tags({{9, "$EXTMIN"}, {10, "0.0"}, {20, "0.0"}}));
  EXPECT_EQ(read(bytes).paths.size(), 1u);
}

TEST(ReadDxf, AcceptsBlanksBeforeFirstTag) {
  EXPECT_EQ(read(std::string(100, ' ') + dxf_of(line(0, 0, 1, 0))).paths.size(), 1u);
}

TEST(ReadDxf, RejectsOtherFormats) {
  EXPECT_THAT(message_of("AutoCAD Binary DXF\r\n\x1a"), HasSubstr("binary DXF"));
  EXPECT_THAT(message_of(std::string("AC1015\0\0\0", 9)), HasSubstr("DWG"));
  for (const std::string& blank : {std::string(), std::string("\n"), std::string("\r\n \t\r\n"), std::string(100, ' ')})
    EXPECT_THAT(message_of(blank), HasSubstr("the file is empty"));
  EXPECT_THAT(message_of("solid cube\n facet normal 0 0 1\n"), HasSubstr("test.dxf:1: error"));
  EXPECT_THAT(message_of(tags({{0, "EOF"}})), HasSubstr("no ENTITIES"));
}

TEST(ReadDxf, RejectsTruncatedFile) {
  const std::string whole = dxf_of(line(0, 0, 1, 0));
  // A file that ends after its entities lacks only EOF, and is read.
  const std::size_t entities_end = whole.size() - tags({{0, "EOF"}}).size();
  for (std::size_t size = 0; size + 1 < entities_end; ++size)
    EXPECT_NE(message_of(whole.substr(0, size)), "no error") << size;
  EXPECT_EQ(message_of(whole.substr(0, entities_end)), "no error");
}

TEST(ReadDxf, FindsBlocksInAnyCase) {
  const std::string block = tags({{0, "BLOCK"}, {2, "Hole"}}) + line(1, 0, 3, 0) + tags({{0, "ENDBLK"}});
  EXPECT_EQ(only_path(tags({{0, "INSERT"}, {2, "HOLE"}}), block).points.size(), 2u);
}

// Curves that are not read are not silently missing.
TEST(ReadDxf, ReportsCurvesThatAreNotRead) {
  const auto remark = [](const std::string& entity) {
    const Drawing drawing = read(dxf_of(entity));
    return drawing.remarks.empty() ? "none" : drawing.remarks.front().text;
  };
  EXPECT_EQ(remark(tags({{0, "SPLINE"}, {8, "cut"}, {71, "3"}, {74, "2"}, {11, "0"}, {21, "0"}, {11, "9"}, {21, "0"}})),
            "this SPLINE has no control points and is not read: export it as a polyline");
  EXPECT_EQ(remark(tags({{0, "REGION"}, {8, "cut"}})), "this REGION is not read: explode it to lines and arcs");
  EXPECT_EQ(remark(tags({{0, "CIRCLE"}, {8, "cut"}, {40, "5"}, {210, "1"}, {230, "0"}})),
            "this CIRCLE lies out of the plane and is not read");
  EXPECT_EQ(remark(tags({{0, "TEXT"}, {8, "cut"}, {210, "1"}, {230, "0"}})), "none");
  EXPECT_EQ(check_drawing(read(dxf_of(tags({{0, "REGION"}, {8, "cut"}})))).at(1).where,
            "the drawing has no lines to cut, and these are not read: REGION");
}

TEST(ReadDxf, OmitsHiddenEntities) {
  const auto layer = [](const std::string& name, const std::string& flags, const std::string& colour) {
    return tags({{0, "LAYER"}, {2, name}, {70, flags}, {62, colour}});
  };
  const std::string tables = tags({{0, "SECTION"}, {2, "TABLES"}, {0, "TABLE"}, {2, "LAYER"}, {70, "4"}}) +
                             layer("Cut", "0", "1") + layer("Old", "0", "-1") + layer("Ice", "1", "7") +
                             layer("Locked", "4", "7") + tags({{0, "ENDTAB"}, {0, "ENDSEC"}});
  const std::string blocks = tags({{0, "BLOCK"}, {2, "part"}, {10, "0"}, {20, "0"}}) + line(0, 0, 1, 0, "cut") +
                             line(0, 2, 1, 2, "0") + tags({{0, "ENDBLK"}});
  const auto placed = [](const std::string& on) {
    return tags({{0, "INSERT"}, {8, on}, {2, "part"}, {10, "50"}, {20, "0"}});
  };
  const std::string invisible = tags({{0, "LINE"}, {8, "cut"}, {60, "1"}, {10, "0"}, {20, "0"}, {11, "9"}, {21, "9"}});
  const Drawing drawing =
      read(tables + dxf_of(line(0, 0, 10, 0, "CUT") + line(0, 5, 10, 5, "old") + line(0, 6, 10, 6, "ICE") +
                               line(0, 7, 10, 7, "locked") + invisible + placed("old") + placed("ice"),
                           4, blocks));
  std::vector<std::string> layers;
  for (const DrawingPath& path : drawing.paths) layers.push_back(path.layer);
  EXPECT_THAT(layers, ElementsAre("CUT", "locked", "cut"));
  std::vector<std::string> remarks;
  for (const DrawingRemark& remark : drawing.remarks) remarks.push_back(remark.text);
  EXPECT_THAT(remarks, ElementsAre(HasSubstr("its layer 'old' is off"), HasSubstr("its layer 'ICE' is frozen"),
                                   HasSubstr("it is invisible"),
                                   HasSubstr("this INSERT is not read: its layer 'ice' is frozen")));
  EXPECT_THAT(drawing.ignored, ElementsAre("INSERT hidden", "LINE hidden"));
}

TEST(ReadDxf, RejectsRecursiveBlocks) {
  const std::string block =
      tags({{0, "BLOCK"}, {2, "a"}, {0, "INSERT"}, {2, "a"}, {0, "INSERT"}, {2, "a"}, {0, "ENDBLK"}});
  EXPECT_THAT(message_of(dxf_of(tags({{0, "INSERT"}, {2, "a"}}), 4, block)), HasSubstr("nested"));
}

TEST(ReadDxf, RejectsExcessiveBlocks) {
  std::string blocks = tags({{0, "BLOCK"}, {2, "0"}}) + line(0, 0, 1, 0) + tags({{0, "ENDBLK"}});
  for (int k = 1; k < 10; ++k) {
    blocks += tags({{0, "BLOCK"},
                    {2, std::to_string(k)},
                    {0, "INSERT"},
                    {2, std::to_string(k - 1)},
                    {70, "100"},
                    {71, "100"},
                    {0, "ENDBLK"}});
  }
  EXPECT_THAT(message_of(dxf_of(tags({{0, "INSERT"}, {2, "9"}}), 4, blocks)), HasSubstr("inserts more than"));
}

/// Inputs that once failed in the fuzzer, and a few hundred damaged drawings: each gives a drawing or an InputError.
TEST(ReadDxf, AnyBytesAreSafe) {
  std::vector<std::string> seeds;
  for (const auto& entry : std::filesystem::directory_iterator(FUSEE_SOURCE_DIR "/tests/fuzz/corpus/dxf"))
    seeds.push_back(read_file(entry.path(), 1 << 20));
  ASSERT_GE(seeds.size(), 3u);
  std::mt19937 random(1);
  for (const std::string& seed : seeds) {
    for (int round = 0; round < 100; ++round) {
      std::string bytes = seed;
      for (int k = 0; k < round && !bytes.empty(); ++k)
        bytes[random() % bytes.size()] = "0123456789.-\nEA"[random() % 15];
      try {
        check_drawing(read(bytes));
      } catch (const InputError&) {
      }
    }
  }
}

}  // namespace
}  // namespace fusee::formats
