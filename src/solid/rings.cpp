#include "solid/rings.h"

#include <algorithm>

#include "fusee/base.h"
#include "solid/caps.h"
#include "solid/nearest_float.h"
#include "solid/plane_distance.h"

namespace fusee::solid {
namespace {

Vec3 lifted(const Vec2& point, double z) { return {point.x(), point.y(), z}; }

// The diagonal of a strip's quad is the shorter one. True if it runs from a[i] to b[j], also if both are equally long.
bool rises_forward(const Ring& a, const Ring& b, std::size_t i, std::size_t j) {
  return (a.points[i] - b.points[j]).squaredNorm() <= (a.points[j] - b.points[i]).squaredNorm();
}

// A rim of more points is finely sampled.
constexpr std::size_t k_fine_rim = 256;

// Additional points on a flat face with a finely sampled rim. Without them, rim and coarse holes would be joined by
// thousands of adjacent needles, which slow down every search through the mesh. The points form loops further and
// further inside the rim, each with half as many points as the one before.
std::vector<Vec2> points_within(const std::vector<Polygon>& loops) {
  const Polygon& rim = loops.front();
  std::vector<Vec2> points;
  if (rim.size() <= k_fine_rim) return points;
  const auto middle_of = [](const Polygon& loop) {
    Vec2 sum = Vec2::Zero();
    for (const Vec2& point : loop) sum += point;
    return Vec2(sum / static_cast<double>(loop.size()));
  };
  std::vector<Bar> holes;
  for (std::size_t k = 1; k < loops.size(); ++k) {
    const Vec2 middle = middle_of(loops[k]);
    double radius = 0;
    for (const Vec2& point : loops[k]) radius = std::max(radius, (point - middle).norm());
    holes.push_back({middle, middle, radius});
  }
  const Vec2 centre = middle_of(rim);
  const double length = perimeter(rim);
  double depth = 0;
  for (std::size_t stride = 2; rim.size() / stride >= k_fine_rim / 4; stride *= 2) {
    const double spacing = length * static_cast<double>(stride) / static_cast<double>(rim.size());
    depth += spacing;
    for (std::size_t i = 0; i < rim.size(); i += stride) {
      const Vec2 inward = centre - rim[i];
      const Vec2 place = rim[i] + inward * std::min(0.9, depth / inward.norm());
      const Vec2 point(nearest_float(place.x()), nearest_float(place.y()));
      if (std::all_of(holes.begin(), holes.end(), [&](const Bar& hole) {
            return gap({point, point, spacing}, hole) > 0;
          }))
        points.push_back(point);
    }
  }
  return points;
}

class StackMesher {
 public:
  explicit StackMesher(const RingStack& stack) : stack_(stack) {}

  TriangleMesh mesh() {
    std::uint32_t below = 0;
    for (std::size_t k = 0; k < stack_.rings.size(); ++k) {
      const std::uint32_t above = add_loop(stack_.rings[k].points, stack_.rings[k].z);
      if (k > 0) join_rings(stack_.rings[k - 1], stack_.rings[k], below, above);
      below = above;
    }
    add_holes(below);
    return has_short_edges_ ? without_collapsed_facets(mesh_) : std::move(mesh_);
  }

 private:
  std::uint32_t add_loop(const Polygon& points, double z) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const Vec2& point : points) mesh_.vertices.push_back(lifted(point, z));
    return first;
  }

  enum class Facing { outward, inward };

  void join_rings(const Ring& a, const Ring& b, std::uint32_t below, std::uint32_t above,
                  Facing facing = Facing::outward) {
    const std::size_t n = a.points.size();
    demand(b.points.size() == n,
           "rings of " + std::to_string(n) + " and " + std::to_string(b.points.size()) + " points");
    const std::size_t first = mesh_.triangles.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      const auto ai = below + static_cast<std::uint32_t>(i), aj = below + static_cast<std::uint32_t>(j);
      const auto bi = above + static_cast<std::uint32_t>(i), bj = above + static_cast<std::uint32_t>(j);
      if (rises_forward(a, b, i, j)) {
        mesh_.triangles.push_back({ai, aj, bj});
        mesh_.triangles.push_back({ai, bj, bi});
      } else {
        mesh_.triangles.push_back({ai, aj, bi});
        mesh_.triangles.push_back({aj, bj, bi});
      }
    }
    if (facing == Facing::outward) return;
    for (std::size_t k = first; k < mesh_.triangles.size(); ++k)
      std::swap(mesh_.triangles[k][1], mesh_.triangles[k][2]);
  }

  // The walls of a hole face its inside.
  void join_shaft(std::uint32_t low, std::uint32_t high, std::size_t n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto j = static_cast<std::uint32_t>((i + 1) % n);
      mesh_.triangles.push_back({low + i, high + j, low + j});
      mesh_.triangles.push_back({low + i, high + i, high + j});
    }
  }

  struct FlatFace {
    std::vector<const Polygon*> loops;
    std::vector<std::uint32_t> firsts;  // number of each loop's first vertex

    void add(const Polygon& loop, std::uint32_t first) {
      loops.push_back(&loop);
      firsts.push_back(first);
    }
  };

  // Adds the hub's wall and the ledge around it. Its top remains open.
  FlatFace add_hub(const Shaft& hub, std::uint32_t top_ring) {
    const std::uint32_t low = add_loop(hub.outline, hub.low);
    const std::uint32_t high = add_loop(hub.outline, hub.high);
    join_shaft(high, low, hub.outline.size());  // exchanged ends turn the wall outwards
    FlatFace ledge{{&stack_.rings.back().points}, {top_ring}};
    ledge.add(hub.outline, low);
    close(ledge, true);
    return {{&hub.outline}, {high}};
  }

  // Adds the recess' walls. Its ceiling, or its end in the top, remains open.
  FlatFace add_recess(FlatFace& bottom) {
    std::uint32_t below = add_loop(stack_.recess.front().points, stack_.recess.front().z);
    bottom.add(stack_.recess.front().points, below);
    for (std::size_t k = 1; k < stack_.recess.size(); ++k) {
      const Ring& ring = stack_.recess[k];
      const std::uint32_t above = add_loop(ring.points, ring.z);
      join_rings(stack_.recess[k - 1], ring, below, above, Facing::inward);
      below = above;
    }
    return {{&stack_.recess.back().points}, {below}};
  }

  // Adds hub, recess and through holes, and the flat faces that they pierce: the top, the bottom, the recess' ceiling.
  void add_holes(std::uint32_t top_ring) {
    FlatFace top = stack_.hub ? add_hub(*stack_.hub, top_ring) : FlatFace{{&stack_.rings.back().points}, {top_ring}};
    FlatFace bottom{{&stack_.rings.front().points}, {0}};
    FlatFace ceiling;
    if (!stack_.recess.empty()) ceiling = add_recess(bottom);
    const bool has_ceiling = !stack_.recess.empty() && !recess_goes_through(stack_);
    if (recess_goes_through(stack_)) top.add(stack_.recess.back().points, ceiling.firsts.front());
    for (const Shaft& shaft : stack_.through) {
      const std::uint32_t low = add_loop(shaft.outline, shaft.low);
      const std::uint32_t high = add_loop(shaft.outline, shaft.high);
      join_shaft(low, high, shaft.outline.size());
      top.add(shaft.outline, high);
      (shaft.low == bottom_height() ? bottom : ceiling).add(shaft.outline, low);
    }
    close(top, true);
    close(bottom, false);
    if (has_ceiling) close(ceiling, false);
  }

  double bottom_height() const { return stack_.rings.front().z; }

  // Triangulates a flat face. Coinciding neighbours among its loops' points are left out.
  void close(const FlatFace& face, bool facing_up) {
    std::vector<Polygon> loops;
    std::vector<std::uint32_t> index;
    for (std::size_t k = 0; k < face.loops.size(); ++k) {
      const Polygon& loop = *face.loops[k];
      Polygon& distinct = loops.emplace_back();
      for (std::uint32_t i = 0; i < loop.size(); ++i) {
        if (loop[i] == loop[(i + 1) % loop.size()]) {
          has_short_edges_ = true;
          continue;
        }
        distinct.push_back(loop[i]);
        index.push_back(face.firsts[k] + i);
      }
    }
    const std::vector<Vec2> inner = points_within(loops);
    const auto first_inner = add_loop(inner, mesh_.vertices[index.front()].z());
    for (std::uint32_t i = 0; i < inner.size(); ++i) index.push_back(first_inner + i);
    for (const auto& [a, b, c] : triangulate(loops, inner)) {
      if (facing_up) {
        mesh_.triangles.push_back({index[a], index[b], index[c]});
      } else {
        mesh_.triangles.push_back({index[a], index[c], index[b]});
      }
    }
  }

  const RingStack& stack_;
  TriangleMesh mesh_;
  bool has_short_edges_ = false;  ///< a loop of a flat face has edges of length 0
};

// Half-way between two rings, the strip's section is the polygon through the midpoints of its verticals and diagonals.
Polygon middle_section(const Ring& a, const Ring& b) {
  const std::size_t n = a.points.size();
  Polygon middle;
  middle.reserve(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    middle.push_back(0.5 * (a.points[i] + b.points[i]));
    middle.push_back(rises_forward(a, b, i, j) ? Vec2(0.5 * (a.points[i] + b.points[j]))
                                               : Vec2(0.5 * (a.points[j] + b.points[i])));
  }
  return middle;
}

// Volume between consecutive rings. The section's area is a quadratic in z, so Simpson's rule is exact.
double stacked_volume(const std::vector<Ring>& rings) {
  double volume = 0;
  for (std::size_t k = 1; k < rings.size(); ++k) {
    const Ring& a = rings[k - 1];
    const Ring& b = rings[k];
    const double areas = signed_area(a.points) + 4.0 * signed_area(middle_section(a, b)) + signed_area(b.points);
    volume += (b.z - a.z) * areas / 6.0;
  }
  return volume;
}

double prism_volume(const Shaft& shaft) { return signed_area(shaft.outline) * (shaft.high - shaft.low); }

}  // namespace

bool recess_goes_through(const RingStack& stack) {
  return !stack.recess.empty() && stack.recess.back().z == (stack.hub ? stack.hub->high : stack.rings.back().z);
}

RingStack scaled_to_float(RingStack stack, double scale) {
  const auto round = [scale](Polygon& points, double& z) {
    for (Vec2& point : points) point = {nearest_float(scale * point.x()), nearest_float(scale * point.y())};
    z = nearest_float(scale * z);
  };
  for (Ring& ring : stack.rings) round(ring.points, ring.z);
  for (Ring& ring : stack.recess) round(ring.points, ring.z);
  const auto round_shaft = [&](Shaft& shaft) {
    round(shaft.outline, shaft.low);
    shaft.high = nearest_float(scale * shaft.high);
  };
  for (Shaft& shaft : stack.through) round_shaft(shaft);
  if (stack.hub) round_shaft(*stack.hub);
  return stack;
}

TriangleMesh mesh_of(const RingStack& stack) {
  demand(stack.rings.size() >= 2, "a stack of " + std::to_string(stack.rings.size()) + " rings");
  return StackMesher(stack).mesh();
}

double volume_of(const RingStack& stack) {
  double volume = stacked_volume(stack.rings) - stacked_volume(stack.recess);
  for (const Shaft& shaft : stack.through) volume -= prism_volume(shaft);
  if (stack.hub) volume += prism_volume(*stack.hub);
  return volume;
}

}  // namespace fusee::solid
