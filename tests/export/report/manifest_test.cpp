#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "export/report/report.h"
#include "export/report/tendon_lengths.h"
#include "support/shapes.h"

namespace fusee::formats {
namespace {

using Json = nlohmann::json;

Product sample_product() {
  Product product;
  product.file.mechanism = testing::plain_mechanism();
  product.joint.mechanism = product.file.mechanism;
  product.file.path = "/home/maker/joints/finger.toml";
  product.file.sha256 = sha256("finger");
  product.synthesis = testing::pulley_of(testing::circle(20), testing::circle(20));
  product.pulley.layout.z_p1 = 3.0;
  product.pulley.layout.z_p2 = 8.0;
  product.pulley.layout.scale = 1.01;
  product.pulley.layout.notes = {"no hub"};
  product.as_built.max_theta_error = radians(0.01);
  product.as_built.max_excess = 0.002;
  product.checks = {at_most("theta_error", 0.01, 0.05, "deg"), exactly("euler", 0, 0, "1")};
  return product;
}

TEST(Manifest, HasAgreedStructure) {
  const std::vector<OutputFile> outputs = {{"pulley.stl", "bytes"}, {"profile.csv", ""}};
  const Json manifest = Json::parse(manifest_json(sample_product(), outputs));
  EXPECT_EQ(manifest["schema"], 1);
  EXPECT_TRUE(manifest["tool"].get<std::string>().starts_with("fusee "));
  EXPECT_EQ(manifest["input"], Json({{"file", "finger.toml"}, {"sha256", sha256("finger")}, {"set", Json::object()}}));
  ASSERT_EQ(manifest["grooves"].size(), 2U);
  EXPECT_EQ(manifest["grooves"][0]["pulley"], "P1");
  EXPECT_DOUBLE_EQ(manifest["grooves"][0]["z_mm"], 3.03);
  EXPECT_EQ(manifest["grooves"][1]["pulley"], "P2");
  EXPECT_DOUBLE_EQ(manifest["grooves"][1]["z_mm"], 8.08);
  EXPECT_EQ(manifest["tendon"]["diameter_mm"], 1.0);
  EXPECT_NEAR(manifest["as_built"]["max_theta_error_deg"].get<double>(), 0.01, 1e-12);
  EXPECT_EQ(manifest["as_built"]["max_slack_mm"], 0.002);
  EXPECT_EQ(manifest["checks"][0],
            Json({{"name", "theta_error"}, {"value", 0.01}, {"limit", 0.05}, {"unit", "deg"}, {"ok", true}}));
  EXPECT_EQ(manifest["outputs"][0], Json({{"file", "pulley.stl"}, {"bytes", 5}, {"sha256", sha256("bytes")}}));
  EXPECT_EQ(manifest["outputs"].size(), 2U);
  EXPECT_EQ(manifest["notes"], Json({"no hub"}));
  EXPECT_EQ(manifest["status"], "done");
}

TEST(Manifest, HasMechanismInFileUnits) {
  const Json mechanism = Json::parse(manifest_json(sample_product(), {}))["mechanism"];
  EXPECT_EQ(mechanism["name"], "test");
  EXPECT_EQ(mechanism["joint"]["length_mm"], 100.0);
  EXPECT_NEAR(mechanism["joint"]["range_deg"][0].get<double>(), -30.0, 1e-9);
  EXPECT_EQ(mechanism["pulley"]["law"], "compensate");
  EXPECT_EQ(mechanism["body"]["nut_trap"], true);
}

TEST(Manifest, ExcludesMachineAndInvalidText) {
  Product product = sample_product();
  product.joint.mechanism.name = "\xFF\"quoted\"";
  const std::string text = manifest_json(product, {});
  EXPECT_EQ(text.find("maker"), std::string::npos);
  EXPECT_TRUE(Json::accept(text));
}

TEST(Manifest, InvalidNumberIsNullAndFails) {
  Product product = sample_product();
  product.as_built.max_excess = std::numeric_limits<double>::infinity();
  product.checks.push_back(at_most("volume", std::numeric_limits<double>::quiet_NaN(), 1, "mm³", "nowhere"));
  const Json manifest = Json::parse(manifest_json(product, {}));
  EXPECT_TRUE(manifest["as_built"]["max_slack_mm"].is_null());
  EXPECT_TRUE(manifest["checks"][2]["value"].is_null());
  EXPECT_EQ(manifest["checks"][2]["ok"], false);
  EXPECT_EQ(manifest["checks"][2]["where"], "nowhere");
  EXPECT_EQ(manifest["status"], "check_failed");
}

/// Round pulleys, whose tendon lengths follow from tangents to circles.
TEST(TendonLengths, MatchesCircle) {
  Product product = sample_product();
  const Mechanism& m = product.joint.mechanism;
  product.synthesis = testing::pulley_of(testing::circle(20), testing::circle(20), 3600);
  const transmission::Transmission transmission(m);
  product.synthesis.stroke = {transmission.at_alpha(0)};
  const transmission::TransmissionPoint& home = product.synthesis.stroke[0];
  // Each tendon leaves at its `lower_normal` and is wound on for a quarter turn: counter-clockwise on P1, clockwise on
  // P2. The active arc is a single point in the middle of that quarter.
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const transmission::TendonPoint& tendon = side == transmission::Side::left ? home.t1 : home.t2;
    const double r = side == transmission::Side::left ? 20.0 : tendon.p;
    profile::Outline& outline = side == transmission::Side::left ? product.synthesis.p1 : product.synthesis.p2;
    outline = testing::sampled(testing::circle(r), side, 3600, 0, 1);
    const double turn = side == transmission::Side::left ? k_pi / 2 : -k_pi / 2;
    solid::Anchor anchor;
    anchor.side = side;
    anchor.exit = (r - 0.5) * unit(tendon.lower_normal + turn);
    anchor.pocket = 0.5 * anchor.exit;
    product.pulley.anchors.push_back(anchor);
    outline.active_first = outline.active_last =
        static_cast<std::size_t>(
            std::lround(std::fmod(tendon.lower_normal + 0.5 * turn + 2 * k_two_pi, k_two_pi) / k_two_pi * 3600)) %
        3600;
  }
  const std::vector<TendonLength> lengths = tendon_lengths(product);
  ASSERT_EQ(lengths.size(), 2U);
  for (const TendonLength& length : lengths) {
    const transmission::TendonPoint& tendon = length.side == transmission::Side::left ? home.t1 : home.t2;
    const double r = length.side == transmission::Side::left ? 20.0 : tendon.p;
    // The free tendon, a quarter turn, and from the exit at r − 0.5 mm half way to the axis. The exit is exact to half a
    // step of the outline.
    EXPECT_NEAR(length.between_knots, tendon.length + r * k_pi / 2 + 0.5 * (r - 0.5), 0.5 * r * k_two_pi / 3600);
    EXPECT_NEAR(length.spare_lap, k_pi / 4, 0.004);
    // Two knots of 12 diameters and two tails of 50 mm, in whole 5 mm.
    EXPECT_GE(length.cut, length.between_knots + 24 * m.tendon.diameter + 100);
    EXPECT_LT(length.cut, length.between_knots + 24 * m.tendon.diameter + 105);
    EXPECT_EQ(std::fmod(length.cut, 5.0), 0.0);
    EXPECT_EQ(length.joint_knot, Vec2(0, 100));
    EXPECT_DOUBLE_EQ(length.pulley_knot.z(), 1.01 * (length.side == transmission::Side::left ? 3.0 : 8.0));
  }
}

TEST(TendonLengths, IsEmptyWithoutAnchors) { EXPECT_TRUE(tendon_lengths(sample_product()).empty()); }

TEST(Manifest, ReportsDerivedNumbers) {
  Product product = sample_product();
  EXPECT_FALSE(Json::parse(manifest_json(product, {})).contains("derived"));
  product.file.mechanism.identified.pins.radius = 1.5;
  product.joint.mechanism.guides.radius += 1.5;
  product.joint.mechanism.pulley.law = Law::table;
  const Json manifest = Json::parse(manifest_json(product, {}));
  EXPECT_EQ(manifest["mechanism"]["guides"]["radius_mm"], 2.0);
  EXPECT_EQ(manifest["mechanism"]["identified"]["guide_radius_mm"], 1.5);
  EXPECT_EQ(manifest["derived"]["guides.radius_mm"], Json({{"declared", 2.0}, {"made", 3.5}}));
  EXPECT_EQ(manifest["derived"]["pulley.law"], Json({{"declared", "compensate"}, {"made", "table"}}));
  EXPECT_EQ(manifest["derived"].size(), 2u);
}

}  // namespace
}  // namespace fusee::formats
