// profile.dxf read back: the curves are in place and the drawing passes its checks.
#include <gmock/gmock.h>

#include "drawing_tools.h"
#include "export/drawings/cut_shapes.h"
#include "export/drawings/dxf_writer.h"
#include "export/drawings/fitted_arcs.h"
#include "fusee/base.h"
#include "solid/nearest_segment.h"
#include "support/shapes.h"

namespace fusee::formats {
namespace {

using testing::egg;
using testing::failed;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::on_layer;
using testing::product_of;

class BothVersions : public ::testing::TestWithParam<DxfVersion> {
 protected:
  Drawing drawn(const Product& product) const { return read_dxf(profile_dxf(product, GetParam()), "profile.dxf"); }
};
INSTANTIATE_TEST_SUITE_P(ProfileDxf, BothVersions, ::testing::Values(DxfVersion::ac1015, DxfVersion::r12));

TEST_P(BothVersions, ReadsCurvesBackWithinMicrons) {
  const Product product = egg();
  const Drawing drawing = drawn(product);
  EXPECT_TRUE(drawing.millimetres);
  const std::vector<std::pair<std::string, Polygon>> expected = {
      {"P1_PITCH", profile::parallel(product.synthesis.p1, 0)},
      {"P1_FLOOR", profile::parallel(product.synthesis.p1, -0.5)},
      {"P2_PITCH", profile::parallel(product.synthesis.p2, 0)},
      {"P2_FLOOR", profile::parallel(product.synthesis.p2, -0.5)}};
  for (const auto& [layer, points] : expected) {
    const auto paths = on_layer(drawing, layer);
    ASSERT_EQ(paths.size(), 1u) << layer;
    EXPECT_TRUE(paths[0].closed);
    // The arcs stay within 0.0005 mm of the outline, and the reader's chords within 0.001 mm of the arcs.
    const solid::NearestSegment drawn_curve({paths[0].points});
    for (const Vec2& point : points) EXPECT_LE(drawn_curve.distance(point), 0.0016) << layer;
    EXPECT_NEAR(signed_area(paths[0].points) / signed_area(points), 1, 5e-3) << layer;
  }
}

TEST_P(BothVersions, RoundPulleyIsCircle) {
  const Drawing drawing = drawn(egg());
  for (const auto& [layer, diameter] : {std::pair{"P1_PITCH", 32.0}, {"P1_FLOOR", 31.0}}) {
    const auto paths = on_layer(drawing, layer);
    ASSERT_EQ(paths.size(), 1u) << layer;
    EXPECT_EQ(paths[0].entity, "CIRCLE") << layer;
    EXPECT_NEAR(paths[0].diameter.value_or(0), diameter, 1e-6) << layer;
  }
}

/// The number behind a tag, in hexadecimal digits; the largest of several.
int largest_handle(const std::string& text, const std::string& tag) {
  int largest = 0;
  for (std::size_t at = text.find(tag); at != std::string::npos; at = text.find(tag, at + 1))
    largest = std::max(largest, std::stoi(text.substr(at + tag.size(), 8), nullptr, 16));
  return largest;
}

TEST(ProfileDxf, SeedsHandlesAboveVerticesInSpace) {
  DxfDocument document;
  document.layers = {{"PATH"}};
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i) points.emplace_back(i, 0, 0.1 * i);
  document.add_in_space("PATH", points);
  const std::string text = dxf_text(document, DxfVersion::ac1015);
  const int seed = largest_handle(text, "$HANDSEED\n  5\n");
  ASSERT_GT(seed, 0) << text.substr(0, 2000);
  EXPECT_GT(seed, largest_handle(text.substr(text.find("$HANDSEED") + 20), "\n  5\n"));
}

TEST(ProfileDxf, FitsFewTangentArcs) {
  const Product product = egg();
  for (const double distance : {0.0, -0.5}) {
    const std::vector<BulgeVertex> arcs = fitted_arcs(product.synthesis.p2, distance, 0.0005);
    EXPECT_LT(arcs.size(), 0.5 * static_cast<double>(product.synthesis.p2.points.size()));
    double turn = 0;
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const BulgeVertex &here = arcs[i], &next = arcs[(i + 1) % arcs.size()], &after = arcs[(i + 2) % arcs.size()];
      const Vec2 chord = next.place - here.place, next_chord = after.place - next.place;
      const double end = 2 * std::atan(here.bulge), start = 2 * std::atan(next.bulge);
      EXPECT_NEAR(std::atan2(cross(chord, next_chord), chord.dot(next_chord)), end + start, 1e-6)
          << "a corner at arc " << i;
      turn += 2 * end;
    }
    EXPECT_NEAR(turn, k_two_pi, 1e-6);
  }
}

// If the normals belong to no smooth curve, the outline's edges are kept.
TEST(ProfileDxf, KeepsEdgesWithoutArcs) {
  profile::Outline outline = egg().synthesis.p2;
  for (profile::OutlinePoint& point : outline.points) point.normal = -point.normal;
  const std::vector<BulgeVertex> edges = fitted_arcs(outline, 0, 0.0005);
  ASSERT_EQ(edges.size(), outline.points.size());
  for (const BulgeVertex& edge : edges) EXPECT_EQ(edge.bulge, 0);
}

TEST_P(BothVersions, PassAllChecks) {
  const auto checks = check_drawing(drawn(egg()));
  EXPECT_THAT(failed(checks), IsEmpty());
}

TEST_P(BothVersions, SameInputSameBytes) { EXPECT_EQ(profile_dxf(egg(), GetParam()), profile_dxf(egg(), GetParam())); }

TEST(ProfileDxf, BoreHasShaftDiameter) {
  Product product = egg();
  product.joint.mechanism.material.hole_compensation = 0.3;
  product.joint.mechanism.material.shrinkage = 0.01;
  const auto bore = on_layer(read_dxf(profile_dxf(product, DxfVersion::ac1015), "profile.dxf"), "BORE");
  ASSERT_EQ(bore.size(), 1u);
  for (const Vec2& p : bore[0].points) EXPECT_NEAR(p.norm(), 3, 1e-6);
}

TEST_P(BothVersions, RoundBoreIsCircleOfShaft) {
  const auto bore = on_layer(drawn(egg()), "BORE");
  ASSERT_EQ(bore.size(), 1u);
  EXPECT_EQ(bore[0].entity, "CIRCLE");
  EXPECT_TRUE(bore[0].closed);
  EXPECT_THAT(profile_dxf(egg(), GetParam()), HasSubstr(" 10\n0.0\n 20\n0.0\n 30\n0.0\n 40\n3.0\n"));
}

TEST_P(BothVersions, DBoreIsArcAndFlat) {
  Product product = egg();
  product.joint.mechanism.body.bore = Bore::d;
  product.joint.mechanism.body.bore_flat = 5;
  const auto bore = on_layer(drawn(product), "BORE");
  ASSERT_EQ(bore.size(), 1u);
  for (const Vec2& p : bore[0].points) EXPECT_NEAR(p.norm(), 3, 1e-6);
  // A circle of 3 mm without the segment beyond 2 mm. The reader's chords stay within 0.001 mm of it.
  const double segment = 9 * std::acos(2.0 / 3.0) - 2 * std::sqrt(5.0);
  EXPECT_NEAR(signed_area(bore[0].points), 9 * k_pi - segment, 0.001 * k_two_pi * 3);
  EXPECT_THAT(failed(check_drawing(drawn(product))), IsEmpty());
}

TEST_P(BothVersions, HornScrewHolesAreCircles) {
  Product product = egg();
  product.joint.mechanism.body.bore = Bore::horn;
  product.joint.mechanism.body.horn = "lynxmotion-ses";
  const auto bore = on_layer(drawn(product), "BORE");
  EXPECT_GT(bore.size(), 2u);
  EXPECT_THAT(bore, ::testing::Each(::testing::Field(&DrawingPath::entity, "CIRCLE")));
}

TEST_P(BothVersions, HexBoreHasSixCorners) {
  Product product = egg();
  product.joint.mechanism.body.bore = Bore::hex;
  const auto bore = on_layer(drawn(product), "BORE");
  ASSERT_EQ(bore.size(), 1u);
  EXPECT_EQ(bore[0].points.size(), 6u);
}

TEST(ProfileDxf, CheckSquareIsTenMillimetres) {
  const auto squares = on_layer(read_dxf(profile_dxf(egg(), DxfVersion::ac1015), "profile.dxf"), "CHECK_10MM");
  ASSERT_EQ(squares.size(), 1u);
  EXPECT_NEAR(signed_area(squares[0].points), 100, 1e-6);
  EXPECT_NEAR(perimeter(squares[0].points), 40, 1e-6);
}

TEST(ProfileDxf, MarksTakeOff) {
  Product product = product_of(testing::circle(16), testing::circle(20));
  product.synthesis.stroke[1].t1.lower_normal = radians(171.3);
  product.synthesis.stroke[1].t2.lower_normal = radians(7.9);
  const auto marks = on_layer(read_dxf(profile_dxf(product, DxfVersion::ac1015), "profile.dxf"), "MARK_TAKE_OFF");
  // The tendon's line begins at the contact and runs up.
  const auto begins_at = [&](const Vec2& p) {
    return std::any_of(marks.begin(), marks.end(), [&](const DrawingPath& m) {
      return (m.points[0] - p).norm() < 0.01 && m.points.size() == 2 && m.points[1].y() > p.y();
    });
  };
  EXPECT_TRUE(begins_at(16 * unit(radians(171.3))));
  EXPECT_TRUE(begins_at(20 * unit(radians(7.9))));
}

TEST(ProfileDxf, HeaderHasUnitsAndExtents) {
  const std::string text = profile_dxf(egg(), DxfVersion::ac1015);
  EXPECT_THAT(text, HasSubstr("$INSUNITS\n 70\n     4\n"));
  EXPECT_THAT(text, HasSubstr("$EXTMIN"));
  EXPECT_THAT(text, HasSubstr("not scaled for a print's shrinkage"));
}

TEST(OffsetEdges, IsExactForPolygons) {
  const Polygon square = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  EXPECT_NEAR(signed_area(offset_edges(square, 0.25)), 4.5 * 4.5, 1e-12);
  EXPECT_NEAR(signed_area(offset_edges(square, -0.25)), 3.5 * 3.5, 1e-12);
  // A reflex corner: an L keeps its shape.
  const Polygon ell = {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};
  EXPECT_NEAR(signed_area(offset_edges(ell, -1)), 8 * 2 + 2 * 6, 1e-12);
}

}  // namespace
}  // namespace fusee::formats
