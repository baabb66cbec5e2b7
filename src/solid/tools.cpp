#include "solid/tools.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "solid/boolean.h"
#include "solid/caps.h"
#include "solid/set_screw.h"

namespace fusee::solid {
namespace {

// Number of facets of a set screw's hole in its first variant.
constexpr int k_hole_facets = 20;

using Indices = std::vector<std::uint32_t>;

// Builds a mesh from vertical walls and horizontal faces over the same points of the plane.
class Levels {
 public:
  explicit Levels(const std::vector<Vec2>& points) : points_(points) {}

  // Number of the vertex over a point at a height, which is added if it is new.
  std::uint32_t vertex(std::uint32_t point, double z) {
    for (std::size_t k = 0; k < heights_.size(); ++k) {
      if (heights_[k] == z) return number(k, point);
    }
    heights_.push_back(z);
    numbers_.emplace_back(points_.size(), k_none);
    return number(heights_.size() - 1, point);
  }

  void wall(const Indices& loop, double low, double high) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      mesh_.triangles.push_back({vertex(a, low), vertex(b, low), vertex(b, high)});
      mesh_.triangles.push_back({vertex(a, low), vertex(b, high), vertex(a, high)});
    }
  }

  void face(const std::vector<Indices>& loops, double z, bool up) {
    std::vector<Polygon> polygons;
    Indices index;
    for (const Indices& loop : loops) {
      polygons.emplace_back();
      for (const std::uint32_t point : loop) {
        polygons.back().push_back(points_[point]);
        index.push_back(vertex(point, z));
      }
    }
    for (const auto& [a, b, c] : triangulate(polygons)) {
      mesh_.triangles.push_back(up ? std::array{index[a], index[b], index[c]}
                                   : std::array{index[a], index[c], index[b]});
    }
  }

  TriangleMesh mesh() { return std::move(mesh_); }

 private:
  static constexpr std::uint32_t k_none = static_cast<std::uint32_t>(-1);

  std::uint32_t number(std::size_t level, std::uint32_t point) {
    std::uint32_t& known = numbers_[level][point];
    if (known == k_none) {
      known = static_cast<std::uint32_t>(mesh_.vertices.size());
      mesh_.vertices.emplace_back(points_[point].x(), points_[point].y(), heights_[level]);
    }
    return known;
  }

  const std::vector<Vec2>& points_;
  std::vector<double> heights_;
  std::vector<Indices> numbers_;
  TriangleMesh mesh_;
};

// Round below, with a peaked ceiling above; x across, y up, about the hole's axis. The ridge is at the intersection of
// the tangents at both ends.
Polygon teardrop(double radius, double ceiling_slope, int facets) {
  Polygon points;
  const double round = k_two_pi - 2.0 * ceiling_slope;
  for (int k = 0; k <= facets; ++k) points.push_back(radius * unit(0.5 * k_pi + ceiling_slope + round * k / facets));
  points.push_back(radius / elementary::cos(ceiling_slope) * unit(0.5 * k_pi));
  return points;
}

TriangleMesh screw_hole(const SetScrewLayout& screw, double reach, int facets) {
  TriangleMesh hole = prism({teardrop(0.5 * screw.hole_diameter, screw.ceiling_slope, facets)}, 0.0, reach);
  // (across, up, out) is right-handed like the prism's (x, y, z).
  const Vec2 out = unit(screw.angle), across = turned_left(out);
  for (Vec3& v : hole.vertices) {
    const Vec2 plane = v.x() * across + v.z() * out;
    v = {plane.x(), plane.y(), screw.z + v.y()};
  }
  return hole;
}

TriangleMesh nut_slot(const SetScrewLayout& screw, double hub_top) {
  const Vec2 out = unit(screw.angle), across = turned_left(out);
  const Vec2 middle = screw.nut_distance * out;
  const Vec2 to_outer = 0.5 * screw.nut_thickness * out, to_side = 0.5 * screw.nut_width * across;
  return prism({{middle - to_outer - to_side, middle + to_outer - to_side, middle + to_outer + to_side,
                 middle - to_outer + to_side}},
               screw.z - nut_corner(screw), hub_top + k_overshoot);
}

}  // namespace

TriangleMesh prism(const std::vector<Polygon>& loops, double low, double high) {
  std::vector<Vec2> points;
  std::vector<Indices> indices;
  for (const Polygon& loop : loops) {
    indices.emplace_back();
    for (const Vec2& point : loop) {
      indices.back().push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(point);
    }
    // Walls have the solid on their left: outlines run counter-clockwise, holes clockwise.
    const bool counter_clockwise = signed_area(loop) > 0;
    if (counter_clockwise != (indices.size() == 1)) std::reverse(indices.back().begin(), indices.back().end());
  }
  Levels levels(points);
  for (const Indices& loop : indices) levels.wall(loop, low, high);
  levels.face(indices, low, false);
  levels.face(indices, high, true);
  return levels.mesh();
}

void turn_inside_out(TriangleMesh& mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

std::vector<Vec3> at_height(const Polygon& outline, double z) {
  std::vector<Vec3> points;
  for (const Vec2& point : outline) points.emplace_back(point.x(), point.y(), z);
  return points;
}

TriangleMesh strip(const std::vector<std::vector<Vec3>>& sections) {
  TriangleMesh mesh;
  const auto corners = static_cast<std::uint32_t>(sections.front().size());
  for (const std::vector<Vec3>& section : sections)
    mesh.vertices.insert(mesh.vertices.end(), section.begin(), section.end());
  const auto last = static_cast<std::uint32_t>(sections.size() - 1) * corners;
  for (std::uint32_t c = 1; c + 1 < corners; ++c) {
    mesh.triangles.push_back({0, c + 1, c});
    mesh.triangles.push_back({last, last + c, last + c + 1});
  }
  for (std::uint32_t k = 0; k < last; k += corners) {
    for (std::uint32_t c = 0; c < corners; ++c) {
      const std::uint32_t a = k + c, b = k + (c + 1) % corners;
      mesh.triangles.push_back({a, b, b + corners});
      mesh.triangles.push_back({a, b + corners, a + corners});
    }
  }
  if (enclosed_volume(mesh) < 0) turn_inside_out(mesh);
  return mesh;
}

TriangleMesh set_screw_tool(const SetScrewLayout& screw, double hub_radius, double hub_top, int variant) {
  const TriangleMesh hole = screw_hole(screw, hub_radius + k_overshoot, k_hole_facets + variant);
  if (!screw.nut_trap) return hole;
  const auto both = unite(rounded_to_float(hole), rounded_to_float(nut_slot(screw, hub_top)));
  demand(both.has_value(), "set screw and nut trap do not join");
  return both->mesh;
}

}  // namespace fusee::solid
