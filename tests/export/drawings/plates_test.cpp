// plates.dxf: kerf, dowels, order and nesting, measured on the drawing or on its plates.
#include "export/drawings/plates.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "drawing_tools.h"
#include "export/drawings/cut_shapes.h"
#include "export/drawings/dxf_writer.h"
#include "export/drawings/nesting.h"
#include "export/drawings/plane_shapes.h"
#include "export/drawings/polygon_cgal.h"
#include "solid/bore.h"
#include "support/shapes.h"

namespace fusee::formats {
namespace {

using ::testing::Contains;
using testing::egg;
using testing::failed;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::on_layer;
using testing::product_of;

/// A knot pocket and a channel that opens at P1's floor.
Product egg_with_anchor() {
  Product product = egg();
  solid::Anchor anchor;
  anchor.side = transmission::Side::left;
  anchor.exit = Vec2::Zero();
  anchor.pocket = {-8, -8};
  anchor.channel = {{-8.7, -8}, {-8.7, -17}, {-7.3, -17}, {-7.3, -8}};
  product.pulley.anchors = {anchor};
  product.pulley.layout = solid::resolve_layout(product.joint.mechanism, product.synthesis);
  return product;
}

Drawing drawn(const Product& product, DxfVersion version = DxfVersion::ac1015) {
  return read_dxf(plates_dxf(product, version), "plates.dxf");
}

const PlateLayer& layer_named(const Plates& plates, const std::string& name) {
  const auto found =
      std::find_if(plates.layers.begin(), plates.layers.end(), [&](const PlateLayer& l) { return l.name == name; });
  if (found == plates.layers.end()) throw std::out_of_range(name);
  return *found;
}

const PlateLayer& layer_named(Plates&&, const std::string&) = delete;  // it would not live long enough

TEST(Plates, KerfIsExact) {
  const Plates plates = make_plates(product_of(testing::circle(16), testing::circle(20)));
  // The kerf of 0.2 mm is measured from edges, not corners. P1's floor is a polygon of 240 corners at 16 − 0.5 mm.
  const double facet = 15.5 * std::cos(k_pi / 240);
  EXPECT_NEAR(distance_to_edges(layer_named(plates, "P1 CORE").cut_outer[0], {0, 0}), facet + 0.1, 1e-9);
  const PlateLayer& core = layer_named(plates, "P1 CORE");
  const Contour& cut = core.cut_holes[0];
  for (const Vec2& p : cut.points) EXPECT_NEAR(p.norm(), 2.9, 1e-3);  // the bore of 6 mm, less half a kerf
  const Contour& whole = core.holes[0];
  EXPECT_NEAR(distance_to_edges(cut.points, {0, 0}), distance_to_edges(whole.points, {0, 0}) - 0.1, 1e-9);
  ASSERT_TRUE(cut.circle && whole.circle);
  EXPECT_NEAR(cut.circle->diameter, 5.8, 1e-12);
  EXPECT_NEAR(whole.circle->diameter, 6, 1e-12);
}

TEST(Plates, NoKerfChangesNothing) {
  Product product = egg_with_anchor();
  product.joint.mechanism.cut.kerf = 0;
  for (const PlateLayer& layer : make_plates(product).layers) {
    for (std::size_t i = 0; i < layer.holes.size(); ++i)
      EXPECT_NEAR(signed_area(layer.holes[i].points), signed_area(layer.cut_holes[i].points), 1e-9);
    EXPECT_NEAR(signed_area(layer.outer[0]), signed_area(layer.cut_outer[0]), 1e-6);
  }
}

TEST(Plates, CountsFollowTheThickness) {
  EXPECT_EQ(plates_for(3.0, 3.0), 1);
  EXPECT_EQ(plates_for(3.1, 3.0), 2);
  EXPECT_EQ(plates_for(0.5, 3.0), 1);
  Product product = egg();
  product.joint.mechanism.cut.plate =
      0.5;  // a tendon of 1 mm: its core of 1.1 mm and flanges of 1.2 mm take three each
  const Plates plates = make_plates(product);
  EXPECT_EQ(layer_named(plates, "P1 CORE").count, 3);
  EXPECT_EQ(layer_named(plates, "FLANGE 1").count, 3);
  EXPECT_THAT(plates.notes, Contains(HasSubstr("P1 CORE: plates 4 to 6 - z 1.5 to 3 mm")));
}

TEST(Plates, DowelsClearFeaturesAndFitOneWay) {
  const Product product = egg_with_anchor();
  const Plates plates = make_plates(product);
  ASSERT_EQ(plates.dowels.size(), 2u);
  constexpr double k_least_wall = 1.0;  // mm, between cuts
  const double clear = 0.5 * plates.dowel_diameter + k_least_wall;
  for (const PlateLayer& layer : plates.layers) {
    for (const Vec2& dowel : plates.dowels) {
      ASSERT_TRUE(contains(layer.outer[0], dowel)) << layer.name;
      EXPECT_GE(distance_to_edges(layer.outer[0], dowel), clear) << layer.name;
      EXPECT_GE(distance_to_edges(layer.holes[0].points, dowel), clear) << layer.name << ": bore";
    }
  }
  EXPECT_GT(std::abs(plates.dowels[0].norm() - plates.dowels[1].norm()), 1.0) << "turned";
  EXPECT_GT(std::abs(cross(plates.dowels[0].normalized(), plates.dowels[1].normalized())), 0.3) << "flipped";
}

TEST(Plates, ReportsMissingSpaceForDowels) {
  Product product = product_of(testing::circle(6), testing::circle(6));
  product.joint.mechanism.cut.dowel = 6;
  product.joint.mechanism.body.bore_diameter = 8;
  const Plates plates = make_plates(product);
  EXPECT_THAT(plates.dowels, IsEmpty());
  EXPECT_THAT(plates.notes, Contains(HasSubstr("no space for two of 6 mm")));
}

// A recess cannot be cut to a depth. It goes through, and features above it disappear.
TEST(Plates, HornRecessRemovesCentreHole) {
  Product product = product_of(testing::circle(22), testing::circle(22));
  Mechanism& mechanism = product.joint.mechanism;
  mechanism.body.bore = Bore::horn;
  mechanism.body.horn = "dynamixel-xl430";
  const Plates plates = make_plates(product);
  EXPECT_THAT(plates.notes, Contains(HasSubstr("the horn's recess goes through all plates; it would be 2.1 mm deep")));
  for (const PlateLayer& layer : plates.layers) {
    // The recess, eight screw holes and the dowels.
    EXPECT_EQ(layer.holes.size(), 1 + 8 + plates.dowels.size()) << layer.name;
    EXPECT_NEAR(circumradius(layer.holes[0].points), 4.0, 1e-3) << "the boss";
    for (std::size_t i = 0; i < layer.holes.size(); ++i) {
      for (std::size_t j = 0; j < layer.holes.size(); ++j)
        EXPECT_TRUE(i == j || !contains(layer.holes[i].points, layer.holes[j].points[0]))
            << layer.name << i << " " << j;
    }
  }
}

TEST(Plates, CutsTeethWiderThanKerf) {
  Product product = product_of(testing::circle(22), testing::circle(22));
  Mechanism& mechanism = product.joint.mechanism;
  mechanism.body.bore = Bore::horn;
  mechanism.horn = {.spline_teeth = 12, .spline_diameter = 18, .spline_depth = 1.5};
  const Plates coarse_plates = make_plates(product);
  const Polygon coarse = layer_named(coarse_plates, "P1 CORE").cut_holes[0].points;
  ASSERT_EQ(coarse.size(), 4u * 12);
  EXPECT_NEAR(circumradius(coarse), 9 - 0.1, 0.05);
  mechanism.horn = {.spline_teeth = 25, .spline_diameter = 5.92, .spline_depth = 0.3};
  EXPECT_THAT(make_plates(product).notes, Contains(HasSubstr("the bore is omitted: a kerf of 0.2 mm is wider")));
}

TEST(Plates, ChannelIsCutIntoItsCoreOnly) {
  const Product product = egg_with_anchor();
  const Plates with = make_plates(product), without = make_plates(egg());
  const auto area = [](const Plates& plates, const std::string& name) {
    return signed_area(layer_named(plates, name).outer[0]);
  };
  EXPECT_LT(area(with, "P1 CORE"), area(without, "P1 CORE") - 10);
  EXPECT_DOUBLE_EQ(area(with, "P2 CORE"), area(without, "P2 CORE"));
  // Half a kerf on every side: the channel is cut narrower by a whole kerf.
  const Polygon& cut = layer_named(with, "P1 CORE").cut_outer[0];
  const auto x_near = [&](double x) {
    return std::count_if(cut.begin(), cut.end(),
                         [x](const Vec2& p) { return std::abs(p.x() - x) < 1e-9 && p.y() < -9; });
  };
  EXPECT_GE(x_near(-8.6), 1);
  EXPECT_GE(x_near(-7.4), 1);
}

TEST(Plates, PocketIsNoLargerThanPrinted) {
  Product product = egg_with_anchor();
  const auto pocket_of = [&product] {
    double diameter = 0;
    const Plates plates = make_plates(product);
    for (const Contour& hole : layer_named(plates, "FLANGE 1").holes) {
      if (hole.circle && (hole.circle->centre - Vec2(-8, -8)).norm() < 1e-6) diameter = hole.circle->diameter;
    }
    return diameter;
  };
  const double as_planned = pocket_of();
  ASSERT_GT(as_planned, 1);
  product.pulley.layout.pocket_radius *= 0.5;
  EXPECT_LT(pocket_of(), 0.6 * as_planned);
}

TEST(Plates, OmitsChannelThroughPlateWithNote) {
  Product product = egg_with_anchor();
  product.pulley.anchors[0].channel = {{-8.7, -30}, {-7.3, -30}, {-7.3, 30}, {-8.7, 30}};
  const Plates plates = make_plates(product);
  EXPECT_THAT(plates.notes, Contains(HasSubstr("it would cut the plate in two")));
  const Plates whole = make_plates(egg());
  EXPECT_DOUBLE_EQ(signed_area(layer_named(plates, "P1 CORE").outer[0]),
                   signed_area(layer_named(whole, "P1 CORE").outer[0]));
}

class PlatesDrawing : public ::testing::TestWithParam<DxfVersion> {};
INSTANTIATE_TEST_SUITE_P(BothVersions, PlatesDrawing, ::testing::Values(DxfVersion::ac1015, DxfVersion::r12));

TEST_P(PlatesDrawing, PassesAllChecks) {
  const Drawing drawing = drawn(egg_with_anchor(), GetParam());
  EXPECT_THAT(failed(check_drawing(drawing)), IsEmpty());
  EXPECT_EQ(on_layer(drawing, "CUT_OUTER").size(), make_plates(egg_with_anchor()).placed.size());
}

TEST_P(PlatesDrawing, SameInputSameBytes) { EXPECT_EQ(plates_dxf(egg(), GetParam()), plates_dxf(egg(), GetParam())); }

TEST_P(PlatesDrawing, RoundHolesAreCirclesHalfAKerfInside) {
  const Product product = egg_with_anchor();
  const Plates plates = make_plates(product);
  const double pocket = 2 * layout_to_cut(product).pocket_radius;
  std::map<double, int> wanted;  // by diameter
  for (const PlacedPlate& plate : plates.placed) {
    wanted[6 - 0.2] += 1;
    wanted[plates.dowel_diameter - 0.2] += 2;
    if (plates.layers[plate.layer].name == "FLANGE 1") wanted[pocket - 0.2] += 1;
  }
  const auto holes = on_layer(drawn(product, GetParam()), "CUT_INNER");
  for (const auto& [diameter, count] : wanted) {
    EXPECT_EQ(std::count_if(holes.begin(), holes.end(),
                            [d = diameter](const DrawingPath& hole) {
                              return hole.entity == "CIRCLE" &&
                                     std::abs(signed_area(hole.points) - k_pi / 4 * d * d) < 0.01;
                            }),
              count)
        << diameter;
  }
  EXPECT_THAT(holes, ::testing::Each(::testing::Field(&DrawingPath::entity, "CIRCLE")));
}

TEST(CutHole, KeepsArcAboutItsCentre) {
  // A D of 10 mm with its flat 4 mm from the axis, cut with a kerf of 1 mm: 9 mm and 3.5 mm.
  Mechanism mechanism = testing::plain_mechanism();
  mechanism.material.hole_compensation = 0;
  mechanism.body.bore = Bore::d;
  mechanism.body.bore_flat = 9;
  const auto cut = cut_hole(bore_contour(solid::bore_layout(mechanism, 10)), 1);
  ASSERT_TRUE(cut);
  const auto vertices = vertices_of(*cut);
  ASSERT_EQ(vertices.size(), 2u);
  const double half = std::acos(3.5 / 4.5);
  EXPECT_NEAR((vertices[0].place - Vec2(-4.5 * std::sin(half), 3.5)).norm(), 0, 1e-12);
  EXPECT_NEAR((vertices[1].place - Vec2(4.5 * std::sin(half), 3.5)).norm(), 0, 1e-12);
  EXPECT_NEAR(vertices[0].bulge, std::tan((k_two_pi - 2 * half) / 4), 1e-12);
  EXPECT_EQ(vertices[1].bulge, 0);
}

TEST(CutHole, KeepsFlatsOfKeyway) {
  // DIN 6885: a shaft of 8 mm has a key of 2 mm, 1 mm deep in the hub.
  Mechanism mechanism = testing::plain_mechanism();
  mechanism.material.hole_compensation = 0;
  mechanism.body.bore = Bore::keyway;
  const auto cut = cut_hole(bore_contour(solid::bore_layout(mechanism, 8)), 0.4);
  ASSERT_TRUE(cut);
  const auto vertices = vertices_of(*cut);
  ASSERT_EQ(vertices.size(), 4u);
  const double shoulder = std::sqrt(3.8 * 3.8 - 0.8 * 0.8);
  const Vec2 expected[] = {{-0.8, shoulder}, {0.8, shoulder}, {0.8, 4.8}, {-0.8, 4.8}};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR((vertices[i].place - expected[i]).norm(), 0, 1e-12) << i;
  EXPECT_GT(vertices[0].bulge, 1) << "more than half a turn";
}

TEST(PlatesDxf, HolesComeBeforeOutlines) {
  const Drawing drawing = drawn(egg());
  int last_inner = 0, first_outer = 1 << 30;
  for (const DrawingPath& path : drawing.paths) {
    if (path.layer == "CUT_INNER") last_inner = std::max(last_inner, path.line);
    if (path.layer == "CUT_OUTER") first_outer = std::min(first_outer, path.line);
  }
  EXPECT_GT(last_inner, 0);
  EXPECT_LT(last_inner, first_outer);
}

TEST(PlatesDxf, PlatesDoNotOverlap) {
  Product product = egg();
  product.joint.mechanism.cut.sheet_width = 100;
  product.joint.mechanism.cut.sheet_height = 60;
  const Drawing drawing = drawn(product);
  EXPECT_GT(on_layer(drawing, "SHEET").size(), 1u);
  const auto outlines = on_layer(drawing, "CUT_OUTER");
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    for (std::size_t j = i + 1; j < outlines.size(); ++j) {
      const auto remaining = difference(outlines[i].points, {outlines[j].points});
      ASSERT_EQ(remaining.size(), 1u);
      EXPECT_NEAR(signed_area(remaining[0]), signed_area(outlines[i].points), 1e-6);
    }
  }
}

/// The piece that a cutter of this kerf cuts along a path.
Box2d piece_of(const DrawingPath& path, double kerf) {
  const Box2d box = bounding_box(path.points);
  return {box.low + Vec2::Constant(0.5 * kerf), box.high - Vec2::Constant(0.5 * kerf)};
}

// The square was drawn 10 mm wide for every kerf: correcting kerf_mm by its error doubled the kerf.
TEST(PlatesDxf, CheckSquareShowsErrorOfKerf) {
  for (const double declared : {0.0, 0.15, 0.4}) {
    Product product = egg();
    product.joint.mechanism.cut.kerf = declared;
    const auto squares = on_layer(drawn(product), "CHECK_10MM");
    ASSERT_EQ(squares.size(), 1u);
    EXPECT_NEAR(piece_of(squares[0], declared).size().x(), 10, 1e-9);
    EXPECT_NEAR(piece_of(squares[0], declared).size().y(), 10, 1e-9);
    // kerf_mm corrected by the difference is the true kerf.
    const double truth = 0.15;
    EXPECT_NEAR(declared - (piece_of(squares[0], truth).size().x() - 10), truth, 1e-9);
  }
}

TEST(PlatesDxf, CheckSquareLiesOnSheetBesidePlates) {
  for (const double height : {60.0, 200.0}) {
    Product product = egg();
    product.joint.mechanism.cut.sheet_height = height;
    const Drawing drawing = drawn(product);
    const Box2d square = bounding_box(on_layer(drawing, "CHECK_10MM").at(0).points);
    const auto holds = [&square](const DrawingPath& sheet) {
      const Box2d box = bounding_box(sheet.points);
      return (square.low - box.low).minCoeff() >= 2 && (box.high - square.high).minCoeff() >= 2;
    };
    const auto sheets = on_layer(drawing, "SHEET");
    EXPECT_EQ(std::count_if(sheets.begin(), sheets.end(), holds), 1) << height;
    for (const DrawingPath& plate : on_layer(drawing, "CUT_OUTER")) {
      const Box2d box = bounding_box(plate.points);
      EXPECT_GE((square.low - box.high).cwiseMax(box.low - square.high).maxCoeff(), 2 - 1e-9) << height;
    }
  }
}

TEST(PlatesDxf, NotesAreAsWideAsSheet) {
  Product product = egg();
  product.joint.mechanism.name = std::string(200, 'M');  // no blank to break at
  product.joint.mechanism.cut.sheet_width = 120;
  const Drawing drawing = drawn(product);
  const auto notes = on_layer(drawing, "NOTES");
  ASSERT_FALSE(notes.empty());
  for (const DrawingPath& stroke : notes) {
    const Box2d box = bounding_box(stroke.points);
    EXPECT_GE(box.low.x(), 0);
    EXPECT_LE(box.high.x(), 120);
    EXPECT_LT(box.high.y(), 0);
  }
}

TEST(PlatesDxf, EnlargesSheetForLargePlateWithNote) {
  Product product = egg();
  product.joint.mechanism.cut.sheet_width = 30;
  const Plates plates = make_plates(product);
  EXPECT_THAT(plates.notes,
              Contains(::testing::AllOf(HasSubstr("a sheet of 30 x 200 mm"), HasSubstr("MIDDLE requires "))));
  EXPECT_GT(plates.sheet.x(), 30);
  EXPECT_EQ(plates.sheet.y(), 200);
  EXPECT_THAT(failed(check_drawing(drawn(product))), IsEmpty());
}

TEST(PlatesDxf, ReportsKerfWiderThanHoles) {
  Product product = egg_with_anchor();
  product.joint.mechanism.cut.kerf = 7;
  EXPECT_THAT(make_plates(product).notes, Contains(HasSubstr("the bore is omitted: a kerf of 7 mm is wider")));
}

// A random design with a bore of 1.5 mm and a kerf of 0.55 mm failed its own check.
TEST(PlatesDxf, OmitsTooNarrowHole) {
  Product product = egg_with_anchor();
  product.joint.mechanism.cut.kerf = 5.6;  // the bore is 6 mm wide: the cutter's path would be 0.4 mm wide
  EXPECT_THAT(make_plates(product).notes, Contains(HasSubstr("narrower than 1 mm: drill it")));
  EXPECT_THAT(failed(check_drawing(drawn(product))), IsEmpty());
}

TEST(PlatesDxf, EveryPlateHasItsNumber) {
  const Plates plates = make_plates(egg());
  for (const PlacedPlate& plate : plates.placed) {
    EXPECT_GT(plates.layers[plate.layer].label_height, 0);
    EXPECT_THAT(plate_label(plates, plate),
                HasSubstr(std::to_string(plate.number) + "/" + std::to_string(plates.placed.size())));
  }
}

TEST(PlatesDxf, SmallPlatesHaveShortLabels) {
  Product product = product_of(testing::circle(6), testing::circle(6));
  product.joint.mechanism.body.bore_diameter = 2;
  product.joint.mechanism.body.hub_height = 0;
  const Plates plates = make_plates(product);
  for (const PlacedPlate& plate : plates.placed) {
    const PlateLayer& layer = plates.layers[plate.layer];
    ASSERT_GT(layer.label_height, 0) << layer.name;
    EXPECT_THAT(plate_label(plates, plate), HasSubstr(std::to_string(plate.number)));
  }
  // The cutter must be able to cut a dowel's path.
  EXPECT_THAT(failed(check_drawing(drawn(product))), IsEmpty());
}

TEST(Nesting, PacksWithoutOverlap) {
  std::vector<Vec2> sizes;
  for (int i = 0; i < 60; ++i) sizes.emplace_back(5 + (i * 7) % 23, 5 + (i * 11) % 19);
  const Vec2 sheet(100, 60);
  const auto places = nest(sizes, sheet, 2);  // 2 mm between plates and at the margin
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_TRUE(places[i].fits);
    EXPECT_GE(places[i].corner.minCoeff(), 2);
    EXPECT_LE(places[i].corner.x() + sizes[i].x(), 98);
    EXPECT_LE(places[i].corner.y() + sizes[i].y(), 58);
    for (std::size_t j = 0; j < i; ++j) {
      if (places[i].sheet != places[j].sheet) continue;
      const bool apart = places[i].corner.x() + sizes[i].x() + 2 <= places[j].corner.x() ||
                         places[j].corner.x() + sizes[j].x() + 2 <= places[i].corner.x() ||
                         places[i].corner.y() + sizes[i].y() + 2 <= places[j].corner.y() ||
                         places[j].corner.y() + sizes[j].y() + 2 <= places[i].corner.y();
      EXPECT_TRUE(apart) << i << " and " << j;
    }
  }
}

}  // namespace
}  // namespace fusee::formats
