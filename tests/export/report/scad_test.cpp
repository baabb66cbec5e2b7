// The text of pulley.scad. tests/oracle/judge_scad.py runs OpenSCAD on it.
#include <gmock/gmock.h>

#include <cmath>
#include <regex>

#include "export/report/report.h"
#include "support/shapes.h"

namespace fusee::formats {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Product product_of(int count = 240) {
  Product product;
  product.joint.mechanism = testing::plain_mechanism();
  product.synthesis = testing::pulley_of(testing::circle(16), {18, {{1, 0.5, 1}, {2, 1, 0.3}}}, count);
  product.pulley.layout = solid::resolve_layout(product.joint.mechanism, product.synthesis);
  return product;
}

/// The rows of `P1 = [[x, y, psi], …];`.
std::vector<Vec3> array_named(const std::string& text, const std::string& name) {
  const std::size_t begin = text.find("\n" + name + " = [");
  const std::string body = text.substr(begin, text.find("];", begin) - begin);
  std::vector<Vec3> rows;
  const std::regex row(R"(\[(-?[0-9.]+), (-?[0-9.]+), (-?[0-9.]+)\])");
  for (auto it = std::sregex_iterator(body.begin(), body.end(), row); it != std::sregex_iterator(); ++it) {
    rows.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]), std::stod((*it)[3]));
  }
  return rows;
}

TEST(Scad, ArraysMatchFloorsAndNormals) {
  const std::string text = scad_text(product_of());
  const auto p1 = array_named(text, "P1"), p2 = array_named(text, "P2");
  ASSERT_GE(p1.size(), 40u);
  EXPECT_EQ(p1.size(), p2.size());
  for (std::size_t i = 0; i < p1.size(); ++i) {
    EXPECT_NEAR((p1[i].head<2>() - 15.5 * unit(radians(p1[i].z()))).norm(), 0, 2e-5);
    EXPECT_EQ(p1[i].z(), p2[i].z());
  }
}

TEST(Scad, ThinnedPointsKeepCurveAndBox) {
  const auto points = array_named(scad_text(product_of(2000)), "P1");
  EXPECT_LE(points.size(), 200u) << "OpenSCAD would take minutes";
  double high = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 a = points[i].head<2>(), b = points[(i + 1) % points.size()].head<2>();
    EXPECT_GE((0.5 * (a + b)).norm(), 15.5 - 0.03);
    high = std::max(high, a.y());
  }
  EXPECT_NEAR(high, 15.5, 1e-4);
}

TEST(Scad, ParametersAreAtTheTop) {
  Product product = product_of();
  product.joint.mechanism.body.bore_diameter = 6;
  product.pulley.layout = solid::resolve_layout(product.joint.mechanism, product.synthesis);
  const std::string text = scad_text(product);
  EXPECT_THAT(text, HasSubstr("/* [Bore] */"));
  EXPECT_THAT(text, HasSubstr("\nbore = 6; // [1:0.1:40]"));
  EXPECT_THAT(text, HasSubstr("\ngroove_depth = 2; // ["));
  EXPECT_LT(text.find("\nbore = "), text.find("/* [Hidden] */"));
}

TEST(Scad, SliderStepsContainTheNumber) {
  Product product = product_of();
  product.pulley.layout.channel_width = 1.237;    // between steps of 0.05 mm
  product.pulley.layout.flange_thickness = 12.5;  // beyond the end
  const std::string text = scad_text(product);
  EXPECT_THAT(text, HasSubstr("\nchannel_width = 1.237; // [0.3:0.001:5]\n"));
  EXPECT_THAT(text, HasSubstr("\nflange_thickness = 12.5; // [0.4:0.1:13]\n"));
}

TEST(Scad, OmitsParametersOfMissingFeatures) {
  Product product = product_of();
  product.pulley.layout.set_screw = {};
  const std::string none = scad_text(product);
  EXPECT_GT(none.find("\nset_screw = false;"), none.find("/* [Hidden] */"));
  product.pulley.layout.set_screw.present = true;
  const std::string with = scad_text(product);
  EXPECT_LT(with.find("\nset_screw = true;"), with.find("/* [Hidden] */"));
}

TEST(Scad, NonConvexBodiesStateConvexity) {
  const std::string text = scad_text(product_of());
  for (const std::string body : {" polyhedron(", "bore_outline();"}) {
    std::size_t found = text.find(body);
    ASSERT_NE(found, std::string::npos) << body;
    for (; found != std::string::npos; found = text.find(body, found + 1)) {
      const std::size_t begin = text.rfind('\n', found);
      EXPECT_THAT(text.substr(begin, text.find('\n', found) - begin), HasSubstr("convexity = "));
    }
  }
}

/// The number after `name =`.
double number_named(const std::string& text, const std::string& name) {
  const std::string begin = "\n" + name + " = ";
  const std::size_t at = text.find(begin);
  EXPECT_NE(at, std::string::npos) << name;
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + begin.size()));
}

Product printed_as(Parts parts, Flange flange = Flange::follow, bool supports = false) {
  Product product = product_of();
  Mechanism& mechanism = product.joint.mechanism;
  mechanism.print.parts = parts;
  mechanism.print.supports = supports;
  mechanism.body.flange = flange;
  product.pulley.layout = solid::resolve_layout(mechanism, product.synthesis);
  return product;
}

TEST(Scad, PrintedPartCanBeChosen) {
  const std::string one = scad_text(printed_as(Parts::one)), two = scad_text(printed_as(Parts::two));
  EXPECT_THAT(one, HasSubstr("\nshow = \"assembled\"; // [assembled, print]\n"));
  EXPECT_THAT(two, HasSubstr("\nshow = \"assembled\"; // [assembled, print, P1, P2]\n"));
  EXPECT_EQ(number_named(one, "parts"), 1);
  EXPECT_EQ(number_named(two, "parts"), 2);
}

TEST(Scad, LedgeWidthMatchesCone) {
  for (const Parts parts : {Parts::one, Parts::two}) {
    const Product product = printed_as(parts, Flange::round);
    const std::string text = scad_text(product);
    const solid::BodyLayout& layout = product.pulley.layout;
    const double steep = std::tan(layout.ceiling_slope);
    EXPECT_NEAR(number_named(text, "upper_ledge") * steep, layout.upper_cone, 2e-5);
    if (parts == Parts::one) {
      EXPECT_GT(layout.middle_cone, 0);
      EXPECT_NEAR(number_named(text, "middle_ledge") * steep, layout.middle_cone, 2e-5);
    } else {
      EXPECT_GT(layout.lower_cone, 0);
      EXPECT_NEAR(number_named(text, "lower_ledge") * steep, layout.lower_cone, 2e-5);
    }
  }
}

TEST(Scad, SupportsAndOverhangAreParameters) {
  Product product = printed_as(Parts::one);
  product.joint.mechanism.print.overhang = radians(50);
  EXPECT_THAT(scad_text(product), HasSubstr("\nsupports = false;\n"));
  EXPECT_THAT(scad_text(product), HasSubstr("\noverhang_deg = 50; // [20:1:75]\n"));
  EXPECT_THAT(scad_text(printed_as(Parts::one, Flange::follow, true)), HasSubstr("\nsupports = true;\n"));
}

TEST(Scad, ContainsServoTeeth) {
  Product product = product_of();
  EXPECT_THAT(scad_text(product), HasSubstr("\nhorn_teeth = [];"));
  product.joint.mechanism.body.bore = Bore::horn;
  product.joint.mechanism.body.horn = "spline-25T-futaba";
  product.pulley.layout = solid::resolve_layout(product.joint.mechanism, product.synthesis);
  const std::string text = scad_text(product);
  const std::size_t from = text.find("\nhorn_teeth = [["), to = text.find("]];", from);
  ASSERT_NE(from, std::string::npos);
  // Four corners a tooth, plus the corners of the centre screw's hole.
  EXPECT_EQ(std::count(text.begin() + from, text.begin() + to, '['), 1 + 4 * 25 + 4);
  EXPECT_THAT(text, HasSubstr("\nhorn_recess = 4.2;"));
}

TEST(Scad, NamesStayInComments) {
  Product product = product_of();
  product.joint.mechanism.name = "two\nlines(); cube(9);";
  EXPECT_THAT(scad_text(product), Not(HasSubstr("\nlines")));
}

TEST(Scad, ContainsEveryTieOff) {
  Product product = product_of();
  EXPECT_THAT(scad_text(product), HasSubstr("\nchannels = [];\n"));
  solid::Anchor channel;
  channel.side = transmission::Side::right;
  channel.pocket = {4, 1.5};
  channel.entry = {{0, 0}, {1, 0}, {2, 1}, {4, 1}, {4, 2}, {2, 2}, {1, 1}, {0, 1}};
  solid::Anchor hole;
  hole.side = transmission::Side::left;
  hole.exit = 16 * unit(radians(90));
  hole.channel = {{0.5, 15}, {0, 15.5}, {-0.5, 15}, {0, 14.5}};
  hole.seat = solid::FaceSeat{1.5, 0.75, 0, {0, 15}, 1.9};
  hole.tail = solid::TailSlot{{0, 14}, {5, 14}, 1.3, 1, 0.25, 1.8, 4.5, 3};
  product.pulley.anchors = {channel, hole};
  product.joint.mechanism.material.hole_compensation = 0.2;
  const std::string text = scad_text(product);
  EXPECT_THAT(text, HasSubstr("\nchannels = [\n  [2, [4, 1.5],\n   [[0, 0], [1, 0], [2, 1], [4, 1]],\n"
                              "   [[0, 1], [1, 1], [2, 2], [4, 2]],\n   [2, 0]]];\n"));
  EXPECT_THAT(text, HasSubstr("\nface_holes = [\n  [1, [0, 15], 90, 1.5, 0.75, 1.9]];\n"));
  EXPECT_THAT(text, HasSubstr("\ntail_slots = [\n  [1, [0, 14], [5, 14], 1, 0.25]];\n"));
  EXPECT_THAT(text, HasSubstr("\nclamp_pilots = [\n  [1, [5, 14], 1.6, 4.5]];\n"));
}

TEST(Scad, IsDeterministic) { EXPECT_EQ(scad_text(product_of()), scad_text(product_of())); }

}  // namespace
}  // namespace fusee::formats
