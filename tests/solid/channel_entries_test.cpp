// Channel entries in plan: simple outlines whose walls stand steeply on the groove edge.
#include "solid/channel_entries.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace fusee::solid {
namespace {

// A channel on a round or straight floor. mm
struct Case {
  AnchorPath path;
  double width = 0;        ///< of the channel
  double beyond = 0;       ///< as in flared_edges()
  double groove_edge = 0;  ///< its distance outside the floor, with a margin
  Polygon floor;
  double floor_radius = 0;  ///< radius of the circle about the origin; 0: straight, below y = -d/2
};

constexpr double k_d = 1.0;  // diameter of the tendon

AnchorPath path_at(const Vec2& start, const Vec2& normal, double sense, double fillet, double turn, double straight) {
  AnchorPath path;
  path.start = start;
  path.normal = normal;
  path.sense = sense;
  path.fillet = fillet;
  path.turn = turn;
  path.straight = straight;
  return path;
}

double depth_in_floor(const Case& one, const Vec2& point) {
  return one.floor_radius > 0 ? one.floor_radius - point.norm() : -0.5 * k_d - point.y();
}

// Cases that a search for tie-offs would accept: the pocket lies within the floor.
std::vector<Case> cases() {
  std::vector<Case> cases;
  for (const double sense : {1.0, -1.0}) {
    for (const double fillet : {2.0, 2.6, 4.0}) {
      for (const double turn : {40.0, 55.0, 70.0, 85.0, 115.0}) {
        for (const double width : {1.2, 1.6, 2.2}) {
          for (const double radius : {0.0, 8.0, 16.0, 60.0}) {
            const double angle = 0.7;
            const Vec2 normal = radius > 0 ? unit(angle) : Vec2(0, 1);
            const Vec2 start = radius > 0 ? Vec2((radius + 0.5 * k_d) * normal) : Vec2(0, 0);
            Case one{path_at(start, normal, sense, fillet, radians(turn), 2.0 * width),
                     width,
                     4.0,
                     2.0 - 0.5 * k_d + 0.5,
                     {},
                     radius};
            if (radius > 0) {
              for (int k = 0; k < 256; ++k)
                one.floor.push_back(radius / std::cos(k_pi / 256) * unit(k_two_pi * k / 256));
            } else {
              one.floor = {{-200, -200}, {200, -200}, {200, -0.5 * k_d}, {-200, -0.5 * k_d}};
            }
            // The smallest pocket, with a radius of 0.55 widths, keeps a wall of 0.4 mm to the floor.
            if (depth_in_floor(one, one.path.pocket()) >= 0.55 * width + 0.4) cases.push_back(std::move(one));
          }
        }
      }
    }
  }
  return cases;
}

std::string name_of(const Case& one) {
  return "sense " + std::to_string(one.path.sense) + " fillet " + std::to_string(one.path.fillet) + " turn " +
         std::to_string(degrees(one.path.turn)) + " width " + std::to_string(one.width) + " floor " +
         std::to_string(one.floor_radius);
}

Polygon outline_of(const ChannelEdges& edges) {
  Polygon outline = edges.outer;
  outline.insert(outline.end(), edges.inner.rbegin(), edges.inner.rend());
  return outline;
}

// True if the segments cross at inner points of both.
bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double at_c = cross(b - a, c - a), at_d = cross(b - a, d - a), at_a = cross(d - c, a - c),
               at_b = cross(d - c, b - c);
  return at_c * at_d < 0 && at_a * at_b < 0;
}

int crossings(const Polygon& outline) {
  int count = 0;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j)
      count += cross_each_other(outline[i], outline[(i + 1) % n], outline[j], outline[(j + 1) % n]);
  }
  return count;
}

double from_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double t = std::clamp((p - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-30), 0.0, 1.0);
  return (a + t * (b - a) - p).norm();
}

// True if the point is inside, by the sum of the angles under which the sides are seen. Points within `slack` of the
// outline count as inside.
bool within(const Polygon& outline, const Vec2& point, double slack) {
  double seen = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i] - point, b = outline[(i + 1) % outline.size()] - point;
    if (from_segment(point, outline[i], outline[(i + 1) % outline.size()]) < slack) return true;
    seen += std::atan2(cross(a, b), a.dot(b));
  }
  return std::abs(seen) > k_pi;
}

Vec2 normal_at(const Case& one, const Vec2& point) {
  return one.floor_radius > 0 ? Vec2(point.normalized()) : Vec2(0, 1);
}
double outside_floor(const Case& one, const Vec2& point) {
  return one.floor_radius > 0 ? point.norm() - one.floor_radius : point.y() + 0.5 * k_d;
}

TEST(ChannelEntries, EdgesAreSimpleAndDoNotCross) {
  for (const Case& one : cases()) {
    const ChannelEdges edges = flared_edges(one.path, one.width, one.floor, k_steep_lean, one.beyond);
    ASSERT_EQ(edges.inner.size(), edges.outer.size());
    EXPECT_EQ(crossings(outline_of(edges)), 0) << name_of(one);
    // Sections of the channel do not cross, so its ceiling has no fold.
    for (std::size_t k = 0; k + 1 < edges.inner.size(); ++k)
      EXPECT_FALSE(cross_each_other(edges.inner[k], edges.outer[k], edges.inner[k + 1], edges.outer[k + 1]))
          << name_of(one) << " " << k;
  }
}

TEST(ChannelEntries, ContainChannelOfConstantWidth) {
  for (const Case& one : cases()) {
    const Polygon entry = outline_of(flared_edges(one.path, one.width, one.floor, k_steep_lean, one.beyond));
    const ChannelEdges plain = plain_edges(one.path, one.width);
    // The chords of both outlines, 12 on each arc, lie within the arcs' sagitta of each other.
    const double sagitta = (one.path.fillet + one.width) * (1 - std::cos(one.path.turn / 24));
    for (const Vec2& point : plain.inner) EXPECT_TRUE(within(entry, point, sagitta)) << name_of(one);
    for (const Vec2& point : plain.outer) EXPECT_TRUE(within(entry, point, sagitta)) << name_of(one);
  }
}

TEST(ChannelEntries, BeginAtWallAcrossFloor) {
  for (const Case& one : cases()) {
    const ChannelEdges edges = flared_edges(one.path, one.width, one.floor, k_steep_lean, one.beyond);
    const Vec2 wall = edges.outer.front() - edges.inner.front();
    EXPECT_NEAR(cross(wall.normalized(), one.path.normal), 0, 1e-9) << name_of(one);
    EXPECT_GT(wall.dot(one.path.normal), one.width - 1e-9);
  }
}

// The tip between wall and groove edge must print: a ceiling's step of 0.1833 mm a layer moves it by less than
// PrusaSlicer's 0.1931 mm, for any curvature of its corner.
TEST(ChannelEntries, WallsAreSteepAtGrooveEdge) {
  int walls = 0;
  for (const Case& one : cases()) {
    const ChannelEdges edges = flared_edges(one.path, one.width, one.floor, k_steep_lean, one.beyond);
    for (std::size_t k = 0; k + 1 < edges.outer.size(); ++k) {
      const Vec2 &a = edges.outer[k], &b = edges.outer[k + 1];
      if ((a - b).norm() < 1e-9) continue;
      constexpr int k_places = 8;
      for (int i = 0; i <= k_places; ++i) {
        const Vec2 place = a + (b - a) * i / k_places;
        const double out = outside_floor(one, place);
        if (out < 0 || out > one.groove_edge) continue;
        ++walls;
        const double steep = std::asin(std::min(1.0, std::abs((b - a).normalized().dot(normal_at(one, place)))));
        EXPECT_GE(degrees(steep), 73) << name_of(one) << " " << out << " mm outside the floor";
      }
    }
  }
  EXPECT_GT(walls, 1000);
}

// The ceiling rises from the inner edge to the outer one by the rise that its width requires.
TEST(ChannelEntries, CeilingsKeepTheirRise) {
  for (const Case& one : cases()) {
    for (const double slope : {30.0, 47.5, 62.5}) {
      const ChannelEdges edges = flared_edges(one.path, one.width, one.floor, k_steep_lean, one.beyond);
      const auto at = [&](std::size_t k, bool outer) {
        const Vec2 across = edges.outer[k] - edges.inner[k], place = outer ? edges.outer[k] : edges.inner[k];
        return Vec3(place.x(), place.y(), outer ? across.norm() * std::tan(radians(slope)) : 0.0);
      };
      for (std::size_t k = 0; k + 1 < edges.inner.size(); ++k) {
        for (const auto& [a, b, c] : {std::tuple{at(k, false), at(k, true), at(k + 1, true)},
                                      std::tuple{at(k, false), at(k + 1, true), at(k + 1, false)}}) {
          const Vec3 normal = (b - a).cross(c - a);
          if (normal.norm() < 1e-9) continue;
          EXPECT_GE(degrees(std::atan2(normal.head<2>().norm(), std::abs(normal.z()))), slope - 1e-6) << name_of(one);
        }
      }
    }
  }
}

}  // namespace
}  // namespace fusee::solid
