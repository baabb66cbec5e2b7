#include <algorithm>
#include <cmath>
#include <limits>

#include "fusee/base.h"
#include "fusee/kit.h"
#include "solid/caps.h"

namespace fusee::kit {
namespace {

bool is_inside(const Polygon& polygon, const Vec2& point) {
  bool inside = false;
  for (std::size_t i = 0, k = polygon.size() - 1; i < polygon.size(); k = i++) {
    const Vec2 &a = polygon[i], &b = polygon[k];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

// True inside an odd number of loops.
bool is_within(const std::vector<Polygon>& loops, const Vec2& point) {
  return std::count_if(loops.begin(), loops.end(), [&](const Polygon& loop) { return is_inside(loop, point); }) % 2;
}

// The outlines of a slab's loops, at its lower or its upper end.
std::vector<Polygon> outlines(const Slab& slab, bool above) {
  std::vector<Polygon> loops;
  for (const SlabLoop& loop : slab.loops)
    loops.push_back(outline_of(loop.hull, above ? loop.grow_high : loop.grow_low));
  return loops;
}

double least_radius(const DiscHull& hull) {
  return std::min_element(hull.discs.begin(), hull.discs.end(),
                          [](const Disc& a, const Disc& b) { return a.radius < b.radius; })
      ->radius;
}

/// Least distance between any two loops of a slab, from the corners of one to the edges of the other. Infinite for a
/// single loop.
double least_gap(const std::vector<Polygon>& loops) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loops.size(); ++i) {
    for (std::size_t k = 0; k < loops.size(); ++k) {
      if (i == k) continue;
      for (const Vec2& point : loops[i]) least = std::min(least, distance_to_edges(loops[k], point));
    }
  }
  return least;
}

/// Number of the first mesh vertex of each ring of a slab.
using Firsts = std::vector<std::uint32_t>;

class StackMesh {
 public:
  explicit StackMesh(const SlabBody& body) {
    std::vector<Polygon> below;  // loops at the top of the slab below
    Firsts below_firsts;
    for (const Slab& slab : body.slabs) {
      const std::vector<Polygon> low = outlines(slab, false), high = outlines(slab, true);
      const Firsts low_firsts = add_faces(low, slab.low, below, below_firsts);
      Firsts high_firsts;
      for (std::size_t i = 0; i < high.size(); ++i) {
        high_firsts.push_back(add_ring(high[i], slab.high));
        add_wall(low_firsts[i], high_firsts[i], high[i].size(), slab.loops[i].hole);
      }
      below = high;
      below_firsts = high_firsts;
    }
    add_faces({}, body.slabs.empty() ? 0.0 : body.slabs.back().high, below, below_firsts);
  }

  solid::TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t add_ring(const Polygon& points, double z) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const Vec2& p : points) mesh_.vertices.emplace_back(p.x(), p.y(), z);
    return first;
  }

  void add_wall(std::uint32_t low, std::uint32_t high, std::size_t count, bool hole) {
    const auto n = static_cast<std::uint32_t>(count);
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t k = (i + 1) % n;
      add(low + i, low + k, high + k, hole);
      add(low + i, high + k, high + i, hole);
    }
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool reversed) {
    mesh_.triangles.push_back(reversed ? std::array{a, c, b} : std::array{a, b, c});
  }

  /// Adds the flat faces between the loops `below`, which end at `z`, and the loops `above`, which begin there. Returns
  /// the rings of `above`. A loop that is in both continues without a face and keeps its ring.
  Firsts add_faces(const std::vector<Polygon>& above, double z, const std::vector<Polygon>& below,
                   const Firsts& below_firsts) {
    std::vector<bool> is_continued(below.size(), false);
    Firsts above_firsts;
    std::vector<Polygon> rims;
    std::vector<std::uint32_t> vertex;  // of each rim corner
    const auto add_rim = [&](const Polygon& loop, std::uint32_t first) {
      rims.push_back(loop);
      for (std::uint32_t i = 0; i < loop.size(); ++i) vertex.push_back(first + i);
    };
    for (const Polygon& loop : above) {
      const auto same = std::find(below.begin(), below.end(), loop);
      if (same != below.end()) {
        const auto index = static_cast<std::size_t>(same - below.begin());
        is_continued[index] = true;
        above_firsts.push_back(below_firsts[index]);
      } else {
        above_firsts.push_back(add_ring(loop, z));
        add_rim(loop, above_firsts.back());
      }
    }
    for (std::size_t i = 0; i < below.size(); ++i) {
      if (!is_continued[i]) add_rim(below[i], below_firsts[i]);
    }
    if (rims.empty()) return above_firsts;
    std::vector<Vec2> corners;
    for (const Polygon& rim : rims) corners.insert(corners.end(), rim.begin(), rim.end());
    for (const auto& [a, b, c] : solid::triangulate(rims)) {
      const Vec2 middle = (corners[a] + corners[b] + corners[c]) / 3;
      // The top of the slab below faces up, the bottom of the one above faces down.
      add(vertex[a], vertex[b], vertex[c], !is_within(below, middle));
    }
    return above_firsts;
  }

  solid::TriangleMesh mesh_;
};

}  // namespace

DiscHull disc(const Vec2& centre, double radius) { return {{{centre, radius}}, radius < 3 ? 32 : 72}; }

DiscHull slot(const Vec2& from, const Vec2& to, double radius) {
  return {{{from, radius}, {to, radius}}, radius < 3 ? 24 : 64};
}

DiscHull box(const Vec2& low, const Vec2& high, double radius) {
  const Vec2 in(radius, radius), a = low + in, b = high - in;
  return {{{a, radius}, {{b.x(), a.y()}, radius}, {b, radius}, {{a.x(), b.y()}, radius}}, 24};
}

Polygon outline_of(const DiscHull& hull, double grow) {
  Polygon points;
  points.reserve(static_cast<std::size_t>(hull.corners));
  for (int i = 0; i < hull.corners; ++i) {
    // Normals are half a step off the axes: along an axis two discs of a box would be equally far.
    const Vec2 normal = unit(k_two_pi * (i + 0.5) / hull.corners);
    const auto furthest = std::max_element(hull.discs.begin(), hull.discs.end(), [&](const Disc& a, const Disc& b) {
      return a.centre.dot(normal) + a.radius < b.centre.dot(normal) + b.radius;
    });
    demand(furthest->radius + grow > 0, "a shape of a kit has no extent");
    points.push_back(furthest->centre + (furthest->radius + grow) * normal);
  }
  return points;
}

// Least radius of a hole. Thinner ones are engraved lines, because no screw and no pin is as thin. mm
constexpr double k_finest_hole = 0.4;

SlabBody trimmed(const SlabBody& body, const PrintTrim& trim) {
  SlabBody result;
  for (const Slab& slab : body.slabs) {
    Slab changed = slab;
    for (SlabLoop& loop : changed.loops) {
      if (!loop.hole) continue;
      const double least = least_radius(loop.hull);
      // Engraved lines are not widened.
      if (least < k_finest_hole) continue;
      // With negative compensation, a radius of 0.1 mm remains.
      const double compensation = std::max(0.5 * trim.hole, 0.1 - least);
      // The polygon's sides touch the circle, so its corners lie at radius / cos(π / corners).
      const double beyond_circle = (least + compensation) * (1 / elementary::cos(k_pi / loop.hull.corners) - 1);
      loop.grow_low += compensation + beyond_circle;
      loop.grow_high += compensation + beyond_circle;
    }
    // Width of the chamfer, whose height is at most half of the slab's.
    double foot = std::min(trim.elephant_foot, 0.5 * (slab.high - slab.low) / trim.foot_slope);
    // Chamfers of both sides of a thin wall take at most half of it.
    if (result.slabs.empty() && foot > 0) foot = std::min(foot, 0.25 * least_gap(outlines(changed, false)));
    for (const SlabLoop& loop : slab.loops) foot = std::min(foot, loop.hole ? foot : 0.9 * least_radius(loop.hull));
    if (result.slabs.empty() && foot > 0) {
      Slab chamfer = changed;
      chamfer.high = changed.low = slab.low + foot * trim.foot_slope;
      for (std::size_t i = 0; i < chamfer.loops.size(); ++i) {
        SlabLoop &below = chamfer.loops[i], &above = changed.loops[i];
        below.grow_high = above.grow_low;
        below.grow_low = above.grow_low + (below.hole ? foot : -foot);
      }
      result.slabs.push_back(chamfer);
    }
    result.slabs.push_back(changed);
  }
  return result;
}

solid::TriangleMesh mesh_of(const SlabBody& body, double scale) {
  solid::TriangleMesh mesh = StackMesh(body).take();
  for (Vec3& vertex : mesh.vertices) vertex *= scale;
  return solid::rounded_to_float(std::move(mesh));
}

double volume_of(const SlabBody& body, double scale) {
  double volume = 0;
  for (const Slab& slab : body.slabs) {
    for (const SlabLoop& loop : slab.loops) {
      const Polygon low = outline_of(loop.hull, loop.grow_low), high = outline_of(loop.hull, loop.grow_high);
      Polygon middle = low;
      for (std::size_t i = 0; i < low.size(); ++i) middle[i] = 0.5 * (low[i] + high[i]);
      // Simpson's rule is exact, because the area is a quadratic in z.
      const double area = (signed_area(low) + 4 * signed_area(middle) + signed_area(high)) / 6;
      volume += (loop.hole ? -1 : 1) * area * (slab.high - slab.low);
    }
  }
  return volume * scale * scale * scale;
}

}  // namespace fusee::kit
