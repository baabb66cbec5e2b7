// pulley.scad as text: what OpenSCAD makes of it is judged by tests/oracle/judge_scad.py.
#include <gmock/gmock.h>

#include <regex>

#include "fusee/export/report.h"
#include "support/shapes.h"

namespace fusee {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Product product_of(int count = 240) {
  Product product;
  product.joint.mechanism = testing::plain_mechanism();
  product.synthesis = testing::pulley_of(testing::circle(16), {18, {{1, 0.5, 1}, {2, 1, 0.3}}}, count);
  product.pulley.layout = resolve_layout(product.joint.mechanism, product.synthesis);
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

TEST(Scad, ArraysAreTheFloorsWithTheirNormals) {
  const std::string text = scad_text(product_of());
  const auto p1 = array_named(text, "P1"), p2 = array_named(text, "P2");
  ASSERT_GE(p1.size(), 40u);
  EXPECT_EQ(p1.size(), p2.size());
  for (std::size_t i = 0; i < p1.size(); ++i) {
    EXPECT_NEAR((p1[i].head<2>() - 15.5 * unit(radians(p1[i].z()))).norm(), 0, 2e-5);
    EXPECT_EQ(p1[i].z(), p2[i].z());
  }
}

TEST(Scad, ThinnedPointsStayNearTheCurveAndKeepItsBox) {
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

TEST(Scad, ParametersStandAtTheTopForTheCustomizer) {
  Product product = product_of();
  product.joint.mechanism.body.bore_diameter = 6;
  product.pulley.layout = resolve_layout(product.joint.mechanism, product.synthesis);
  const std::string text = scad_text(product);
  EXPECT_THAT(text, HasSubstr("/* [Bore] */"));
  EXPECT_THAT(text, HasSubstr("\nbore = 6; // [1:0.1:40]"));
  EXPECT_THAT(text, HasSubstr("\ngroove_depth = 2; // ["));
  EXPECT_LT(text.find("\nbore = "), text.find("/* [Hidden] */"));
}

TEST(Scad, TeethOfAServosShaftAreInIt) {
  Product product = product_of();
  EXPECT_THAT(scad_text(product), HasSubstr("\nhorn_teeth = [];"));
  product.joint.mechanism.body.bore = Bore::horn;
  product.joint.mechanism.body.horn = "spline-25T-futaba";
  product.pulley.layout = resolve_layout(product.joint.mechanism, product.synthesis);
  const std::string text = scad_text(product);
  const std::size_t from = text.find("\nhorn_teeth = [["), to = text.find("]];", from);
  ASSERT_NE(from, std::string::npos);
  EXPECT_EQ(std::count(text.begin() + from, text.begin() + to, '['), 1 + 4 * 25);
  EXPECT_THAT(text, HasSubstr("\nhorn_recess = 4.2;"));
}

TEST(Scad, AnyNameStaysInItsComment) {
  Product product = product_of();
  product.joint.mechanism.name = "two\nlines(); cube(9);";
  EXPECT_THAT(scad_text(product), Not(HasSubstr("\nlines")));
}

TEST(Scad, EveryTieOffIsThere) {
  Product product = product_of();
  Anchor anchor;
  anchor.side = Side::right;
  anchor.exit = Vec2::Zero();
  anchor.pocket = {1.25, -2.5};
  anchor.channel = {{0, 0}, {1, 0}, {0, 1}};
  product.pulley.anchors = {anchor};
  EXPECT_THAT(scad_text(product), HasSubstr("tie_offs = [\n  [2, [1.25, -2.5], [[0, 0], [1, 0], [0, 1]]]];"));
}

TEST(Scad, SameInputSameBytes) { EXPECT_EQ(scad_text(product_of()), scad_text(product_of())); }

}  // namespace
}  // namespace fusee
