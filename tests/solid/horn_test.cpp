// A pulley for every horn and shaft of the catalogue and for custom horns. The openings for screws and shafts are
// measured on the mesh, by a slicer that shares no code with the program.
#include <gmock/gmock.h>

#include <map>

#include "fusee/mechanism_file.h"
#include "fusee/solid.h"
#include "mechanism/catalogue.h"
#include "solid/broken.h"
#include "support/shapes.h"

namespace fusee::solid {
namespace {

using testing::circle;
using testing::failed;
using ::testing::HasSubstr;
using testing::plain_mechanism;
using testing::pulley_of;

/// A closed line of a section z = const of a mesh.
struct Loop {
  std::vector<Vec2> points;
  Vec2 middle = Vec2::Zero();  ///< its centroid
  double room = 0;             ///< diameter of the circle about `middle` that touches the nearest side
  double reach = 0;            ///< diameter of the circle about `middle` through the furthest corner
};

double side_distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + t * (b - a) - p).norm();
}

Loop measured(std::vector<Vec2> points) {
  Loop loop{std::move(points)};
  const std::size_t n = loop.points.size();
  double area = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = loop.points[i], &b = loop.points[(i + 1) % n];
    const double part = a.x() * b.y() - a.y() * b.x();
    area += part;
    loop.middle += part * (a + b) / 3;
  }
  loop.middle /= area;
  loop.room = 1e9;
  for (std::size_t i = 0; i < n; ++i) {
    loop.room = std::min(loop.room, 2 * side_distance(loop.middle, loop.points[i], loop.points[(i + 1) % n]));
    loop.reach = std::max(loop.reach, 2 * (loop.points[i] - loop.middle).norm());
  }
  return loop;
}

/// Each facet that crosses the plane gives one side. Sides are joined at equal mesh edges.
std::vector<Loop> sliced(const TriangleMesh& mesh, double z) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::map<Edge, std::vector<Edge>> next;
  const auto at = [&](const Edge& edge) -> Vec2 {
    const Vec3 &a = mesh.vertices[edge.first], &b = mesh.vertices[edge.second];
    return (a + (z - a.z()) / (b.z() - a.z()) * (b - a)).head<2>();
  };
  for (const auto& triangle : mesh.triangles) {
    std::vector<Edge> cut;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      if ((mesh.vertices[a].z() < z) != (mesh.vertices[b].z() < z)) cut.push_back(std::minmax(a, b));
    }
    if (cut.size() != 2) continue;
    next[cut[0]].push_back(cut[1]);
    next[cut[1]].push_back(cut[0]);
  }
  std::vector<Loop> loops;
  while (!next.empty()) {
    std::vector<Vec2> points;
    Edge edge = next.begin()->first;
    while (next.count(edge) > 0) {
      points.push_back(at(edge));
      const std::vector<Edge> neighbours = next[edge];
      next.erase(edge);
      for (const Edge& neighbour : neighbours) {
        if (next.count(neighbour) > 0) edge = neighbour;
      }
    }
    loops.push_back(measured(points));
  }
  return loops;
}

/// The bore: the smallest loop around the axis.
Loop bore_of(const std::vector<Loop>& loops) {
  Loop bore;
  for (const Loop& loop : loops) {
    if (loop.middle.norm() < 0.5 * loop.room && (bore.points.empty() || loop.reach < bore.reach)) bore = loop;
  }
  return bore;
}

std::vector<Loop> round_holes(const std::vector<Loop>& loops, double diameter) {
  std::vector<Loop> holes;
  for (const Loop& loop : loops) {
    if (loop.middle.norm() > 0.5 * diameter && std::abs(loop.room - diameter) < 0.002) holes.push_back(loop);
  }
  return holes;
}

/// Number of times that a loop's outline turns from outward to inward: the number of teeth that fit into it.
int teeth_of(const Loop& loop) {
  const double between = 0.25 * (loop.room + loop.reach);
  int crossings = 0;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Vec2 &a = loop.points[i], &b = loop.points[(i + 1) % loop.points.size()];
    if ((a.norm() < between) != (b.norm() < between)) ++crossings;
  }
  return crossings / 2;
}

constexpr double k_compensation = 0.2;  // of plain_mechanism()

struct BuiltPiece {
  Mechanism mechanism;
  profile::SynthesisResult shape = pulley_of(circle(30), circle(28, {2, 1}));
  Pulley pulley;
  explicit BuiltPiece(Mechanism m) : mechanism(std::move(m)), pulley(make_pulley(mechanism, shape)) {}
};

Mechanism with_horn(const std::string& name) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.bore = Bore::horn;
  mechanism.body.horn = name;
  mechanism.body.marks = Marks::none;
  return mechanism;
}

Mechanism with_horn(const Horn& horn) {
  Mechanism mechanism = with_horn("own");
  mechanism.horn = horn;
  return mechanism;
}

void expect_holes(const BuiltPiece& made, const Horn& horn) {
  ASSERT_TRUE(made.pulley.made()) << made.pulley.brief();
  EXPECT_EQ(failed(check_pulley(made.pulley.mesh, made.mechanism, made.shape, made.pulley, 0.01)), "");
  const double top = bounds(made.pulley.mesh).high.z();
  const double sinks = std::max(horn.boss_height, horn.spline_length);
  // Near the face of the horn or shaft, and above everything that sinks in. No vertex lies at these heights.
  for (const double z : {0.71, top - 0.31}) {
    SCOPED_TRACE(z);
    const std::vector<Loop> loops = sliced(made.pulley.mesh, z);
    const Loop bore = bore_of(loops);
    const bool low = z < sinks;
    if (horn.spline_teeth > 0 && (low || sinks == 0)) {
      EXPECT_EQ(teeth_of(bore), horn.spline_teeth);
      // The bore's furthest corners lie over the shaft's crests, and its nearest sides over the shaft's roots.
      EXPECT_NEAR(bore.reach, horn.spline_diameter + k_compensation, 0.01);
      EXPECT_NEAR(bore.room, horn.spline_diameter - 2 * horn.spline_depth + k_compensation, 0.01);
    } else {
      EXPECT_NEAR(bore.room, (low ? horn.boss_diameter : horn.centre_hole) + k_compensation, 1e-3);
    }
    if (horn.bolt_count == 0) continue;
    const std::vector<Loop> screws = round_holes(loops, horn.bolt_hole + k_compensation);
    ASSERT_EQ(screws.size(), static_cast<std::size_t>(horn.bolt_count));
    for (int k = 0; k < horn.bolt_count; ++k) {
      const double angle = horn.first_bolt + k_two_pi * k / horn.bolt_count;
      const Vec2 wanted = 0.5 * horn.bolt_circle * Vec2(std::cos(angle), std::sin(angle));
      double nearest = 1e9;
      for (const Loop& screw : screws) nearest = std::min(nearest, (screw.middle - wanted).norm());
      EXPECT_LT(nearest, 1e-3) << "screw " << k;
    }
  }
  // The recess is slightly deeper than the part that sinks in, and narrows to the centre screw's hole in a printable
  // cone.
  if (sinks > 0) {
    const double hole = horn.centre_hole + k_compensation, ceiling = sinks + 0.2;
    const Loop wide = bore_of(sliced(made.pulley.mesh, sinks + 0.1));
    EXPECT_GT(wide.reach, hole + 0.2);
    const double cone = 0.5 * (wide.reach - hole) * std::tan(radians(47.5));
    EXPECT_NEAR(bore_of(sliced(made.pulley.mesh, ceiling + cone + 0.05)).room, hole, 1e-3);
    // At 47.5° the diameter falls by 1.83 times the height: between 1.6 and 2 times.
    for (const double share : {0.25, 0.5}) {
      const double narrowed = 2.0 * share * cone / std::tan(radians(45));
      EXPECT_GT(bore_of(sliced(made.pulley.mesh, ceiling + share * cone)).reach, wide.reach - narrowed) << share;
      EXPECT_LT(bore_of(sliced(made.pulley.mesh, ceiling + share * cone)).reach, wide.reach - 0.8 * narrowed) << share;
    }
  }
}

TEST(Horn, EveryCatalogueHornFits) {
  for (const HornType& type : horns()) {
    SCOPED_TRACE(type.name);
    expect_holes(BuiltPiece(with_horn(type.name)), type.horn);
  }
}

TEST(Horn, CustomHornFits) {
  const Horn star{.bolt_circle = 21,
                  .bolt_count = 3,
                  .bolt_hole = 2.2,
                  .first_bolt = radians(25),
                  .centre_hole = 7,
                  .boss_diameter = 12,
                  .boss_height = 2.5};
  expect_holes(BuiltPiece(with_horn(star)), star);
  const Horn through{.spline_teeth = 21, .spline_diameter = 8, .spline_depth = 0.6};
  expect_holes(BuiltPiece(with_horn(through)), through);
}

TEST(Horn, CatalogueHornEqualsItsNumbers) {
  const Pulley named = BuiltPiece(with_horn("dynamixel-xl430")).pulley;
  const Pulley described = BuiltPiece(with_horn(find_horn("dynamixel-xl430")->horn)).pulley;
  EXPECT_EQ(named.mesh.vertices, described.mesh.vertices);
}

TEST(Horn, TurnByOneScrewKeepsVolume) {
  Horn horn{.bolt_circle = 20, .bolt_count = 4, .bolt_hole = 3.2, .centre_hole = 8};
  const Pulley straight = BuiltPiece(with_horn(horn)).pulley;
  horn.first_bolt = radians(90);  // four screws turned by 90° lie as before
  const Pulley turned = BuiltPiece(with_horn(horn)).pulley;
  EXPECT_NEAR(straight.expected_volume, turned.expected_volume, 1e-9 * straight.expected_volume);
}

/// Checks that a custom horn is rejected for one condition, and built with one number changed.
void expect_refused(const Horn& bad, const Horn& good, const std::string& condition, const std::string& words) {
  SCOPED_TRACE(words);
  const Pulley refused = BuiltPiece(with_horn(bad)).pulley;
  ASSERT_FALSE(refused.made());
  for (const profile::Condition& one : refused.conditions) {
    EXPECT_EQ(one.ok, one.name != condition) << one.name;
    if (one.name == condition) {
      EXPECT_THAT(one.message, HasSubstr(words));
    }
  }
  const Pulley made = BuiltPiece(with_horn(good)).pulley;
  EXPECT_TRUE(made.made()) << made.brief();
}

TEST(Horn, RejectsIntersectingHoles) {
  const Horn good{
      .bolt_circle = 16, .bolt_count = 4, .bolt_hole = 2.2, .centre_hole = 5, .boss_diameter = 8, .boss_height = 2};
  Horn bad = good;
  bad.bolt_circle = 10.4;  // 5.2 − 1.2 − 4.1 < 0
  expect_refused(bad, good, "horn_holes",
                 "a larger horn.bolt_circle_mm, or a smaller horn.bolt_hole_mm or horn.boss_diameter_mm");
  bad = good;
  bad.bolt_count = 24;  // 16 sin(7.5°) = 2.09 < 2.4
  expect_refused(bad, good, "horn_holes", "fewer in horn.bolt_count");
  bad = good;
  bad.centre_hole = 7.9;
  expect_refused(bad, good, "horn_holes", "a smaller horn.centre_hole_mm, which leaves a shoulder");
  Horn flat = good, wide = good;
  flat.boss_diameter = flat.boss_height = wide.boss_diameter = wide.boss_height = 0;
  wide.centre_hole = 14;
  expect_refused(wide, flat, "horn_holes", "a smaller horn.bolt_hole_mm or horn.centre_hole_mm");
  bad = good;
  bad.boss_height = 30;
  expect_refused(bad, good, "horn_recess", "horn.boss_height_mm");
  const Horn shaft{
      .centre_hole = 3.2, .spline_teeth = 25, .spline_diameter = 5.92, .spline_depth = 0.3, .spline_length = 4};
  Horn deep = shaft;
  deep.spline_length = 40;
  expect_refused(deep, shaft, "horn_recess", "horn.spline_length_mm");
}

TEST(Horn, AdviceForCustomHornIsTried) {
  Mechanism mechanism = parse_mechanism(find_template("linear_wrist"), "linear_wrist.toml", ".",
                                        {{"body.bore", "horn"},
                                         {"horn.bolt_circle_mm", "10"},
                                         {"horn.bolt_count", "4"},
                                         {"horn.bolt_hole_mm", "2.2"},
                                         {"horn.centre_hole_mm", "5"},
                                         {"horn.boss_diameter_mm", "8"},
                                         {"horn.boss_height_mm", "2"}});
  ASSERT_FALSE(obstacles(mechanism).empty());
  const std::vector<profile::Change> advice = body_advice(mechanism).alone;
  const auto wider = std::find_if(advice.begin(), advice.end(),
                                  [](const profile::Change& c) { return c.key == "horn.bolt_circle_mm"; });
  ASSERT_NE(wider, advice.end());
  mechanism.horn.bolt_circle = wider->to;
  EXPECT_TRUE(obstacles(mechanism).empty());
  for (const profile::Change& change : advice)
    EXPECT_FALSE(change.key.starts_with("horn.") && change.to == 0) << change.text;
}

TEST(Shaft, EveryCatalogueShaftFits) {
  const std::string joint =
      "schema = 1\n[joint]\nlength_mm = 100\nrange_deg = [-30, 30]\n[guides]\nEB_mm = 50\nED_mm = 50\nOE_mm = -40\n"
      "[pulley]\nEF_mm = 80\nr1_mm = 16\n[tendon]\ndiameter_mm = 1\n[body]\nshaft = \"";
  for (const ShaftType& type : shafts()) {
    SCOPED_TRACE(type.name);
    Mechanism mechanism = plain_mechanism();
    mechanism.body = parse_mechanism(joint + type.name + "\"\n", "shaft.toml").body;
    mechanism.body.marks = Marks::none;
    const BuiltPiece made(mechanism);
    ASSERT_TRUE(made.pulley.made()) << made.pulley.brief();
    EXPECT_EQ(failed(check_pulley(made.pulley.mesh, made.mechanism, made.shape, made.pulley, 0.01)), "");
    const std::vector<Vec2> bore = bore_of(sliced(made.pulley.mesh, 0.71)).points;
    double low = 0, high = 0, reach = 0, least = 1e9;
    for (std::size_t i = 0; i < bore.size(); ++i) {
      low = std::min(low, bore[i].y());
      high = std::max(high, bore[i].y());
      reach = std::max(reach, bore[i].norm());
      least = std::min(least, side_distance(Vec2::Zero(), bore[i], bore[(i + 1) % bore.size()]));
    }
    if (type.flat > 0) {
      EXPECT_NEAR(high - low, type.flat + k_compensation, 0.01);
      EXPECT_NEAR(2 * reach, type.diameter + k_compensation, 0.001);
    } else {
      EXPECT_NEAR(2 * least, type.diameter + k_compensation, 0.001);
    }
  }
}

}  // namespace
}  // namespace fusee::solid
