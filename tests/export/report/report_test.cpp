// report.html: one well-formed, self-contained and complete page for any text and any number.
#include "export/report/report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <set>

#include "export/report/html.h"
#include "export/report/mesh_code.h"
#include "export/report/tables.h"
#include "support/mechanisms.h"
#include "support/shapes.h"

namespace fusee::formats {
namespace {

using ::testing::ContainsRegex;

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

/// A closed tube of `count` × `rings` vertices about z: as regular as the meshes of pulleys.
solid::TriangleMesh tube(std::uint32_t count, std::uint32_t rings) {
  solid::TriangleMesh mesh;
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec2 place = (15 + 3 * std::sin(0.7 * ring)) * unit(k_two_pi * i / count);
      mesh.vertices.emplace_back(place.x(), place.y(), 0.5 * ring);
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const std::uint32_t low = ring * count, high = (ring + 1) % rings * count;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t next = (i + 1) % count;
      mesh.triangles.push_back({low + i, low + next, high + next});
      mesh.triangles.push_back({low + i, high + next, high + i});
    }
  }
  return mesh;
}

// A joint with the file's default body.
Mechanism forearm() {
  Mechanism mechanism = testing::plain_mechanism();
  const Mechanism joint = testing::forearm();
  mechanism.name = joint.name;
  mechanism.joint = joint.joint;
  mechanism.guides = joint.guides;
  mechanism.pulley = joint.pulley;
  mechanism.tendon = joint.tendon;
  return mechanism;
}

Product sample(Mechanism mechanism = forearm()) {
  Product product;
  product.joint.mechanism = std::move(mechanism);
  product.file.path = "profiles/forearm.toml";
  product.file.sha256 = std::string(64, 'a');
  product.synthesis = profile::synthesise(product.joint.mechanism);
  product.pulley.status = solid::PulleyStatus::made;
  product.pulley.layout = solid::resolve_layout(product.joint.mechanism, product.synthesis);
  product.pulley.mesh = tube(60, 5);
  const profile::Outline& p1 = product.synthesis.p1;
  const Vec2 exit = p1.points[p1.anchor_end()].position;
  product.pulley.anchors = {
      {transmission::Side::left, true, exit, {exit, 0.9 * exit, 0.8 * turned_left(exit)}, {}, 0.6 * exit, {}, {}}};
  product.pulley.conditions = {{"wall_to_bore", true, 0, 3.1, 1.2, "mm", ""}};
  for (const transmission::TransmissionPoint& point : product.synthesis.stroke) {
    product.as_built.points.push_back(
        {point.alpha, point.theta, point.theta + radians(0.004) * std::sin(point.alpha), 0.002});
  }
  product.holding.loaded.resize(product.synthesis.stroke.size());
  product.as_built.max_theta_error = radians(0.004);
  product.as_built.max_excess = 0.002;
  product.checks = {exactly("open_edges", 0, 0, "1"), at_most("theta_error", 0.004, 0.05, "deg"),
                    at_most("excess_length", 0.002, 0.05, "mm"), at_least("wall", 1.9, 1.2, "mm"),
                    at_most("obj_deviation", 0, 0.01, "mm")};
  return product;
}

pugi::xml_document parsed(const std::string& html) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_string(html.c_str());
  EXPECT_TRUE(result) << result.description() << " at: " << html.substr(static_cast<std::size_t>(result.offset), 120);
  return document;
}

std::string words_of(const pugi::xml_node& node) {
  std::string words;
  for (const auto& text : node.select_nodes(".//text()")) words += std::string(text.node().value()) + " ";
  return words;
}

/// Everything but scripts and styles, in which "nan" and "//" are no fault.
std::string shown(std::string html) {
  for (const std::string element : {"script", "style"}) {
    const std::string close = "</" + element + ">";
    for (std::size_t from; (from = html.find("<" + element)) != std::string::npos;)
      html.erase(from, html.find(close, from) + close.size() - from);
  }
  return html;
}

TEST(Report, IsWellFormed) {
  const auto document = parsed(report_html(sample()));
  EXPECT_STREQ(document.child("html").child("body").child("header").child("h1").text().as_string(), "forearm");
  for (const char* id :
       {"numbers", "part", "moving", "mechanism", "curves", "built", "profiles", "checks", "feasibility", "making"}) {
    EXPECT_EQ(document.select_nodes(("//section[@id='" + std::string(id) + "']").c_str()).size(), 1u) << id;
  }
  EXPECT_GE(document.select_nodes("//svg").size(), 12u);
}

TEST(Report, IsSelfContained) {
  const std::string html = report_html(sample());
  for (const char* reference : {"://", "src=", "url(", "@import", "fetch(", "XMLHttpRequest"}) {
    EXPECT_THAT(html, Not(HasSubstr(reference)));
  }
  // Links are to files of the same build.
  std::set<std::string> linked;
  const std::string link = "href=\"";
  for (std::size_t at = html.find(link); at != std::string::npos; at = html.find(link, at + 1))
    linked.insert(html.substr(at + link.size(), html.find('"', at + link.size()) - at - link.size()));
  EXPECT_THAT(linked,
              UnorderedElementsAre("manifest.json", "mechanism.toml", "plates.dxf", "profile.csv", "profile.dxf",
                                   "profile_p1.csv", "profile_p2.csv", "pulley.3mf", "pulley.drc", "pulley.obj",
                                   "pulley.scad", "pulley.stl", "transmission.csv"));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

TEST(Report, HasBoundedSize) {
  Product product = sample();
  product.pulley.mesh = tube(400, 30);  // 24 000 triangles: more than a pulley has
  const std::size_t without = report_html(sample()).size();
  const std::size_t with = report_html(product).size();
  EXPECT_LT(without, 200'000u);
  EXPECT_LT(with - without, 10u * 24'000u) << "bytes a triangle";
}

TEST(Html, CellsCarryTheTitleOfTheirColumn) {
  EXPECT_EQ(with_labelled_cells("<p><td></p><table><thead><tr><th></th><th class=\"number\">a &amp; b</th></tr></thead>"
                                "<tbody><tr><td>x</td><td class=\"number\">1</td></tr></tbody></table>"),
            "<p><td></p><table><thead><tr><th></th><th class=\"number\">a &amp; b</th></tr></thead>"
            "<tbody><tr><td>x</td><td data-label=\"a &amp; b\" class=\"number\">1</td></tr></tbody></table>");
}

TEST(Report, IsDeterministic) { EXPECT_EQ(report_html(sample()), report_html(sample())); }

TEST(Report, ListsEveryCheckAndCondition) {
  const Product product = sample();
  const auto document = parsed(report_html(product));
  const std::string checks = words_of(document.select_node("//section[@id='checks']").node());
  for (const Check& check : product.checks) {
    const bool in_other_file = check.name == "obj_deviation";
    EXPECT_THAT(checks, HasSubstr(in_other_file ? "Distance to pulley.stl" : plain_name(check.name)));
  }
  EXPECT_THAT(checks, HasSubstr("pulley.obj"));
  const std::string conditions = words_of(document.select_node("//section[@id='feasibility']").node());
  for (const profile::Condition& condition : product.synthesis.conditions)
    EXPECT_THAT(conditions, HasSubstr(plain_name(condition.name)));
  EXPECT_THAT(conditions, HasSubstr("Wall to bore"));
}

TEST(Report, ReportsSuccess) {
  const auto document = parsed(report_html(sample()));
  const auto verdict = document.select_node("//section[contains(@class, 'verdict')]").node();
  EXPECT_STREQ(verdict.attribute("class").as_string(), "verdict good");
  EXPECT_THAT(words_of(verdict), HasSubstr("within 0.004° (limit 0.05°)"));
  EXPECT_THAT(words_of(verdict), HasSubstr("All 5 checks hold"));
}

// A tendon that is slack over the whole range stood in a green box.
TEST(Report, BannerIsAmberForSlackTendon) {
  Mechanism mechanism = forearm();
  mechanism.load.tip_force = 10;
  Product product = sample(mechanism);
  product.under_load = analysis::under_load(mechanism);
  ASSERT_TRUE(product.under_load.taut_pretension);
  const auto colour = [&product] {
    const auto document = parsed(report_html(product));
    return std::string(
        document.select_node("//section[contains(@class, 'verdict')]").node().attribute("class").as_string());
  };
  EXPECT_EQ(colour(), "verdict noted");
  mechanism.tendon.pretension = 1.01 * *product.under_load.taut_pretension;
  product.under_load = analysis::under_load(mechanism);
  EXPECT_EQ(colour(), "verdict good");
}

TEST(Report, BannerReportsLoadAndMotor) {
  Mechanism mechanism = forearm();
  mechanism.load.tip_force = 10;
  mechanism.motor.model = "MG996R";  // 180°, and the range requires 238°
  Product product = sample(mechanism);
  product.under_load = analysis::under_load(mechanism);
  const auto document = parsed(report_html(product));
  const auto verdict = document.select_node("//section[contains(@class, 'verdict')]").node();
  EXPECT_STREQ(verdict.attribute("class").as_string(), "verdict noted");
  EXPECT_THAT(words_of(verdict), HasSubstr("All 5 checks hold. Under 10 N, θ is off by up to 0.0997"));
  EXPECT_THAT(words_of(verdict), HasSubstr("Tendon 1 is slack over the whole range: tendon.pretension_N ≥ "));
  EXPECT_THAT(words_of(verdict), HasSubstr("safety factor against breaking is "));
  const std::string numbers = words_of(document.select_node("//section[@id='numbers']").node());
  EXPECT_THAT(numbers, HasSubstr("MG996R"));
  EXPECT_THAT(numbers, HasSubstr("° of 180° "));
  mechanism.motor.model = "XM430-W210";
  mechanism.tendon.pretension = 40;  // keeps both tendons taut
  product.under_load = analysis::under_load(mechanism);
  EXPECT_THAT(report_html(product), HasSubstr("verdict noted")) << "the bore does not fit the motor";
  mechanism.motor.gear_ratio = 1.1;  // the gearbox's shaft is the bore's
  product.under_load = analysis::under_load(mechanism);
  EXPECT_THAT(report_html(product), HasSubstr("verdict good"));
}

TEST(Report, ReportsFailures) {
  Product product = sample();
  product.checks.push_back(at_most("theta_error", 0.31, 0.05, "deg", "α = 12°"));
  product.checks.push_back(at_least("drc_wall", 0.4, 1.2, "mm"));
  const auto document = parsed(report_html(product));
  const auto verdict = document.select_node("//section[contains(@class, 'verdict')]").node();
  EXPECT_STREQ(verdict.attribute("class").as_string(), "verdict bad");
  EXPECT_THAT(words_of(verdict), HasSubstr("2 of 7 checks failed"));
  EXPECT_THAT(words_of(verdict), HasSubstr("0.31°, limit 0.05°"));
  const auto failed = document.select_nodes("//section[@id='checks']//tr[@class='failed']");
  ASSERT_EQ(failed.size(), 2u);
  EXPECT_THAT(words_of(failed[0].node()), HasSubstr("α = 12°"));
  EXPECT_THAT(words_of(failed[1].node()), HasSubstr("pulley.drc: Wall"));
  EXPECT_THAT(words_of(failed[1].node()), HasSubstr("≥ 1.2"));
  EXPECT_STREQ(document.select_node("//section[@id='checks']//h3").node().text().as_string(), "Failed");
}

TEST(Report, GivesTendonLengths) {
  const std::string words = words_of(parsed(report_html(sample())).select_node("//section[@id='making']").node());
  EXPECT_THAT(words, HasSubstr("Tendon 1"));
  EXPECT_THAT(words, Not(HasSubstr("Tendon 2 "))) << "it has no anchor here";
  EXPECT_THAT(words, HasSubstr("Left on the pulley at full pay-out"));
}

TEST(Report, ExplainsPolyhole) {
  Product product = sample();
  product.pulley.layout.bore.circle = std::nullopt;
  product.pulley.layout.bore.outline = {{2.6, -2.6}, {2.6, 2.6}, {-2.6, 2.6}, {-2.6, -2.6}};
  EXPECT_THAT(report_html(product), Not(HasSubstr("printed corners cut inside")));
  product.pulley.layout.bore.circle = solid::RoundHole{Vec2::Zero(), 5.2};
  EXPECT_THAT(report_html(product), HasSubstr("a polygon of 4 sides on purpose: printed corners cut inside"));
  EXPECT_THAT(report_html(product), HasSubstr("bore ⌀ 5.2 inside the polygon"));
  product.pulley.layout.bore.circle = std::nullopt;
  product.pulley.layout.bore.kind = Bore::d;
  product.pulley.layout.bore.radius = 3;
  EXPECT_THAT(report_html(product), HasSubstr("bore ⌀ 6, 5.6 from the flat"));
}

TEST(Report, GivesMountingInstructions) {
  const auto making = [](const Mechanism& mechanism) {
    return words_of(parsed(report_html(sample(mechanism))).select_node("//section[@id='making']").node());
  };
  Mechanism mechanism = forearm();
  EXPECT_THAT(making(mechanism), HasSubstr("Put the pulley on its shaft with P1 below"));
  mechanism.body.bore = Bore::horn;
  mechanism.body.horn = "feetech-sts3215";
  EXPECT_THAT(making(mechanism), HasSubstr("the first screw 45.0° from +x towards +y"));
  EXPECT_THAT(making(mechanism), HasSubstr("(4 holes on 14 mm) with P1 below"));
  mechanism.body.horn = "spline-25T-futaba";
  EXPECT_THAT(making(mechanism), HasSubstr("It fits every 14.4°"));
}

TEST(Report, ShowsForcesOnlyUnderLoad) {
  Mechanism mechanism = forearm();
  EXPECT_TRUE(parsed(report_html(sample(mechanism))).select_nodes("//section[@id='forces']").empty());
  mechanism.load.tip_force = 20;
  EXPECT_EQ(parsed(report_html(sample(mechanism))).select_nodes("//section[@id='forces']//svg").size(), 4u)
      << "two plots, each in a wide and a narrow layout";
}

TEST(Report, EscapesUserText) {
  const std::string nasty = "<script>alert('x')</script>{{tool}}</style>]]>&\"\x01";
  const std::size_t scripts = parsed(report_html(sample())).select_nodes("//script").size();
  Product product = sample();
  product.joint.mechanism.name = nasty;
  product.joint.mechanism.material = {nasty, 0.002, 0.2, 0.4};
  product.pulley.layout.scale = 1.002;
  product.file.path = nasty;
  product.file.sha256 = nasty;
  Diagnostic warning;
  warning.message = nasty;
  product.file.warnings.push_back(warning);
  product.synthesis.warnings = {nasty};
  product.pulley.layout.notes = {nasty};
  product.checks.push_back(at_most(nasty, 2, 1, nasty, nasty));
  product.synthesis.conditions.push_back({nasty, false, 0, 0, 0, nasty, nasty});
  const auto document = parsed(report_html(product));
  EXPECT_EQ(document.select_nodes("//script").size(), scripts);
  EXPECT_STREQ(document.child("html").child("body").child("header").child("h1").text().as_string(),
               "<script>alert('x')</script>{{tool}}</style>]]>&\"\uFFFD");
}

TEST(Report, AcceptsInvalidNumbers) {
  Product product = sample();
  product.checks.push_back(at_most("deviation", k_nan, 0.01, "mm"));
  product.as_built.max_theta_error = k_nan;
  product.as_built.max_excess = std::numeric_limits<double>::infinity();
  for (profile::RewindPoint& point : product.as_built.points) point.excess = k_nan;
  product.synthesis.stroke[3].t2.p = k_nan;
  product.synthesis.stroke[4].theta = -std::numeric_limits<double>::infinity();
  product.synthesis.p2.points[7].position.x() = k_nan;
  product.synthesis.p2.points[9].curvature_radius = k_nan;
  product.pulley.mesh.vertices[5].y() = k_nan;
  const std::string html = report_html(product);
  parsed(html);
  EXPECT_THAT(shown(html), Not(ContainsRegex("[^a-z](nan|inf)[^a-z]")));
}

TEST(Report, ReportsPartThatWasNotBuilt) {
  Product product;
  const std::string html = report_html(product);
  const auto document = parsed(html);
  EXPECT_THAT(shown(html), Not(ContainsRegex("[^a-z](nan|inf)[^a-z]")));
  EXPECT_STREQ(document.select_node("//section[contains(@class, 'verdict')]").node().attribute("class").as_string(),
               "verdict bad");
}

TEST(PlainNames, SidesAreFilledIn) {
  EXPECT_THAT(plain_name("tendon_on_pin_D"), HasSubstr("Tendon 2 stays on pin D"));
  EXPECT_THAT(plain_name("convex_floor_P1"), HasSubstr("P1’s"));
  EXPECT_EQ(plain_name("3mf_deviation"), "pulley.3mf: Distance to pulley.stl");
  EXPECT_EQ(plain_name("something_new_P3"), "Something new P3");
  EXPECT_EQ(plain_name(""), "");
}

// The mesh inside the page -------------------------------------------------------------------------------------------

std::vector<std::uint32_t> bytes_of(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint32_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count >= 8) bytes.push_back(bits >> (count -= 8) & 255);
  }
  return bytes;
}

/// An independent reader of viewer.js' format.
solid::TriangleMesh decoded(const MeshCode& code) {
  const auto bytes = bytes_of(code.base64);
  std::size_t at = 0;
  const auto varint = [&] {
    std::uint32_t value = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint32_t byte = bytes.at(at++);
      value |= (byte & 127) << shift;
      if (byte < 128) return value;
    }
  };
  solid::TriangleMesh mesh;
  std::array<int, 3> level{0, 0, 0};
  for (std::size_t t = 0; t < code.triangles; ++t) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::uint32_t& index : triangle) {
      const std::uint32_t back = varint();
      index = static_cast<std::uint32_t>(mesh.vertices.size()) - back;
      if (back != 0) continue;
      Vec3 place;
      for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t z = varint();
        level[axis] += z & 1 ? -static_cast<int>((z + 1) / 2) : static_cast<int>(z / 2);
        place[axis] = code.low[axis] + code.step * level[axis];
      }
      mesh.vertices.push_back(place);
    }
    mesh.triangles.push_back(triangle);
  }
  EXPECT_EQ(at, bytes.size());
  return mesh;
}

TEST(MeshCodes, RoundTripIsExactToHalfAStep) {
  for (const solid::TriangleMesh& mesh : {tube(7, 3), tube(100, 11), tube(301, 4)}) {
    const auto code = encode_mesh(mesh);
    ASSERT_TRUE(code.has_value());
    const solid::TriangleMesh back = decoded(*code);
    ASSERT_EQ(back.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(back.vertices.size(), mesh.vertices.size());
    EXPECT_LT(code->step, 0.001);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const Vec3 off = back.vertices[back.triangles[t][k]] - mesh.vertices[mesh.triangles[t][k]];
        EXPECT_LE(off.cwiseAbs().maxCoeff(), 0.5000001 * code->step);
      }
    }
  }
}

TEST(MeshCodes, RejectInvalidMesh) {
  EXPECT_FALSE(encode_mesh({}).has_value());
  solid::TriangleMesh mesh = tube(7, 3);
  mesh.triangles[2][1] = 1000;
  EXPECT_FALSE(encode_mesh(mesh).has_value());
  mesh = tube(7, 3);
  mesh.vertices[0].z() = k_nan;
  EXPECT_FALSE(encode_mesh(mesh).has_value());
  mesh.vertices.assign(3, Vec3(1, 2, 3));
  mesh.triangles = {{0, 1, 2}};
  EXPECT_FALSE(encode_mesh(mesh).has_value());
}

}  // namespace
}  // namespace fusee::formats
