#include "solid/boolean.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/thread_pool.h"
#include "fusee/base.h"
#include "solid/corefinement.h"
#include "solid/disjoint_sets.h"
#include "solid/nearest_float.h"
#include "solid/self_intersection.h"
#include "solid/solid_angle.h"
#include "solid/sorted_by_vertex.h"

// A tool touches about a tenth of a body's facets. Only these are passed to CGAL. It cuts both surfaces into patches
// along the line in which they intersect. One point of each patch decides whether it lies inside or outside the other
// solid.

namespace fusee::solid {
namespace {

enum class Operation { subtract, unite };

// Some facets of a mesh with their own vertices.
class SubMesh {
 public:
  explicit SubMesh(const TriangleMesh& whole) : whole_(whole), number_(whole.vertices.size(), k_none) {}

  void add(const std::array<std::uint32_t, 3>& triangle) {
    auto& facet = mesh_.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& known = number_[triangle[k]];
      if (known == k_none) {
        known = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(whole_.vertices[triangle[k]]);
      }
      facet[k] = known;
    }
  }
  const TriangleMesh& mesh() const { return mesh_; }

 private:
  static constexpr auto k_none = std::numeric_limits<std::uint32_t>::max();
  const TriangleMesh& whole_;
  std::vector<std::uint32_t> number_;
  TriangleMesh mesh_;
};

// The facets of a body that a tool touches, and all others.
struct Neighbourhood {
  TriangleMesh near, far;
};

// The connected components of a mesh.
std::vector<TriangleMesh> pieces_of(const TriangleMesh& mesh) {
  DisjointSets pieces(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    pieces.unite(a, b);
    pieces.unite(a, c);
  }
  std::map<std::size_t, SubMesh> by_root;
  for (const auto& triangle : mesh.triangles)
    by_root.try_emplace(pieces.root(triangle[0]), mesh).first->second.add(triangle);
  std::vector<TriangleMesh> all;
  for (const auto& [root, piece] : by_root) all.push_back(piece.mesh());
  return all;
}

bool touches(const Bounds& box, const Bounds& other) {
  return (box.low.array() <= other.high.array()).all() && (box.high.array() >= other.low.array()).all();
}

Bounds box_of(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3 &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]], &c = mesh.vertices[triangle[2]];
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

// Marks the body's facets whose boxes touch the box of one of the tool's components.
std::vector<bool> touched_by(const TriangleMesh& tool, const TriangleMesh& body) {
  std::vector<Bounds> boxes;
  for (const TriangleMesh& piece : pieces_of(tool)) boxes.push_back(bounds(piece));
  std::vector<bool> touched;
  touched.reserve(body.triangles.size());
  for (const auto& triangle : body.triangles) {
    const Bounds facet = box_of(body, triangle);
    touched.push_back(std::any_of(boxes.begin(), boxes.end(), [&](const Bounds& box) { return touches(facet, box); }));
  }
  return touched;
}

Neighbourhood neighbourhood(const TriangleMesh& body, const std::vector<bool>& touched) {
  SubMesh near(body), far(body);
  for (std::size_t f = 0; f < body.triangles.size(); ++f) (touched[f] ? near : far).add(body.triangles[f]);
  return {near.mesh(), far.mesh()};
}

// A body's facets near a tool, and both surfaces cut along their intersection line.
struct Division {
  TriangleMesh near;
  std::optional<CorefinedPair> cut;  // empty if the facets intersect themselves or are no manifold
};

// Components of a tool, and the body's facets that they alone touch.
struct ContactGroup {
  TriangleMesh near, tool;
};

// Requires every facet of `near` to be touched by a component of the tool.
std::vector<ContactGroup> contact_groups(const TriangleMesh& near, const TriangleMesh& tool) {
  const std::vector<TriangleMesh> pieces = pieces_of(tool);
  if (pieces.size() < 2) return {{near, tool}};
  std::vector<Bounds> boxes;
  for (const TriangleMesh& piece : pieces) boxes.push_back(bounds(piece));
  DisjointSets joined(pieces.size());
  std::vector<std::size_t> piece_at(near.triangles.size());
  for (std::size_t f = 0; f < near.triangles.size(); ++f) {
    const Bounds facet = box_of(near, near.triangles[f]);
    std::size_t first = pieces.size();
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (!touches(facet, boxes[k])) continue;
      if (first == pieces.size()) first = k;
      joined.unite(first, k);
    }
    piece_at[f] = first;
  }
  std::map<std::size_t, std::pair<SubMesh, std::vector<TriangleMesh>>> groups;
  const auto group_of = [&](std::size_t piece) -> auto& {
    return groups.try_emplace(joined.root(piece), SubMesh(near), std::vector<TriangleMesh>()).first->second;
  };
  for (std::size_t f = 0; f < near.triangles.size(); ++f) group_of(piece_at[f]).first.add(near.triangles[f]);
  for (std::size_t k = 0; k < pieces.size(); ++k) group_of(k).second.push_back(pieces[k]);
  std::vector<ContactGroup> all;
  for (const auto& [root, group] : groups) all.push_back({group.first.mesh(), together(group.second)});
  return all;
}

// Cuts all contact groups in parallel. Empty if one of them cannot be cut.
std::optional<CorefinedPair> corefined_apart(const TriangleMesh& near, const TriangleMesh& tool) {
  const std::vector<ContactGroup> all = contact_groups(near, tool);
  std::vector<std::optional<CorefinedPair>> parts(all.size());
  ThreadPool::shared().each(all.size(),
                            [&](std::size_t k, std::size_t) { parts[k] = corefined(all[k].near, all[k].tool); });
  std::optional<CorefinedPair> whole = std::move(parts.front());
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const std::optional<CorefinedPair>& part = parts[k];
    if (!whole || !part) return std::nullopt;
    whole->first.insert(whole->first.end(), part->first.begin(), part->first.end());
    whole->second.insert(whole->second.end(), part->second.begin(), part->second.end());
  }
  return whole;
}

Division divided(TriangleMesh near, const TriangleMesh& tool) {
  Division division{std::move(near), {}};
  // CGAL may fail, return garbage or not terminate if the facets intersect themselves.
  if (!find_crossing(division.near).facets) division.cut = corefined_apart(division.near, tool);
  return division;
}

bool are_same(const TriangleMesh& a, const TriangleMesh& b) {
  return a.triangles == b.triangles && a.vertices == b.vertices;
}

// A point of a patch and the surface's normal there.
struct PatchSample {
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
};

// The sample at the centre of the patch's largest facet.
PatchSample sample_of(const TriangleMesh& patch) {
  PatchSample sample;
  for (const auto& [ia, ib, ic] : patch.triangles) {
    const Vec3 &a = patch.vertices[ia], &b = patch.vertices[ib], &c = patch.vertices[ic];
    const Vec3 normal = (b - a).cross(c - a);
    if (normal.squaredNorm() > sample.normal.squaredNorm()) sample = {(a + b + c) / 3.0, normal};
  }
  sample.normal.stableNormalize();
  return sample;
}

// Winding number of a closed surface about a point.
double winding_number(const TriangleMesh& solid, const Vec3& point) {
  double angle = 0;
  for (const auto& [a, b, c] : solid.triangles)
    angle += solid_angle(solid.vertices[a] - point, solid.vertices[b] - point, solid.vertices[c] - point);
  return angle / (2.0 * k_two_pi);
}

// Parity of the surface crossings straight up from the point. Empty if the ray passes through or close to a facet's
// edge.
std::optional<bool> is_inside_seen_upwards(const TriangleMesh& solid, const Vec3& point) {
  constexpr double k_rounding = 1e-9;  // relative
  const Vec2 at = point.head<2>();
  bool inside = false;
  for (const auto& [ia, ib, ic] : solid.triangles) {
    const Vec3 &a = solid.vertices[ia], &b = solid.vertices[ib], &c = solid.vertices[ic];
    if (std::max({a.z(), b.z(), c.z()}) < point.z() || std::max({a.x(), b.x(), c.x()}) < at.x() ||
        std::min({a.x(), b.x(), c.x()}) > at.x() || std::max({a.y(), b.y(), c.y()}) < at.y() ||
        std::min({a.y(), b.y(), c.y()}) > at.y())
      continue;
    const Vec2 to_a = a.head<2>() - at, to_b = b.head<2>() - at, to_c = c.head<2>() - at;
    // Barycentric weights of the corners. Weights of both signs: the ray passes beside the facet.
    const double weight_a = cross(to_b, to_c), weight_b = cross(to_c, to_a), weight_c = cross(to_a, to_b);
    const auto [least, most] = std::minmax({weight_a, weight_b, weight_c});
    const double tolerance = k_rounding * std::max({to_a.squaredNorm(), to_b.squaredNorm(), to_c.squaredNorm()});
    if (least < -tolerance && most > tolerance) continue;
    // If they are not clearly of one sign either, the ray is close to an edge.
    if (least < tolerance && most > -tolerance) return std::nullopt;
    const double height =
        (weight_a * a.z() + weight_b * b.z() + weight_c * c.z()) / (weight_a + weight_b + weight_c) - point.z();
    if (std::abs(height) < k_rounding * (1.0 + std::abs(point.z()))) return std::nullopt;
    if (height > 0) inside = !inside;
  }
  return inside;
}

// Empty if the point is too close to the surface to decide.
std::optional<bool> is_inside_of(const TriangleMesh& solid, const Vec3& point) {
  if (const auto inside = is_inside_seen_upwards(solid, point)) return inside;
  constexpr double k_integer_tolerance = 1e-3;  // largest distance of a winding number from the nearest integer
  const double winding = winding_number(solid, point);
  if (!(std::abs(winding - std::round(winding)) < k_integer_tolerance)) return std::nullopt;
  return std::lround(winding) != 0;
}

// True where the other solid has material: just below a patch (against its normal), and just above. Both are true
// inside the other solid. Only one is true where the two surfaces coincide.
struct Surroundings {
  bool below = false, above = false;
};

std::optional<Surroundings> surroundings_of(const TriangleMesh& patch, const TriangleMesh& solid) {
  // Coincident surfaces differ by at most float rounding. Other walls are thicker than this.
  constexpr double k_beside = 1e-4;
  const auto [point, normal] = sample_of(patch);
  if (const auto inside = is_inside_seen_upwards(solid, point)) return Surroundings{*inside, *inside};
  const auto below = is_inside_of(solid, point - k_beside * normal),
             above = is_inside_of(solid, point + k_beside * normal);
  if (!below || !above) return std::nullopt;
  return Surroundings{*below, *above};
}

TriangleMesh turned_over(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

struct KeptPatches {
  std::vector<TriangleMesh> result, common;
};

// Sorts the patches of one solid into the result and the intersection. False if one lies too close to the other solid
// to decide. Where the surfaces coincide, the patch of the first solid is used: a patch of the second one is kept only
// if it is completely inside or outside.
bool sort_patches(const std::vector<TriangleMesh>& patches, const TriangleMesh& solid, bool is_first,
                  Operation operation, KeptPatches& kept) {
  for (const TriangleMesh& patch : patches) {
    const std::optional<Surroundings> around = surroundings_of(patch, solid);
    if (!around) return false;
    const auto [below, above] = *around;
    bool is_inside = below && above, is_outside = !below && !above;
    // On coincident surfaces only one is true: `below` if they face the same way, `above` if they face each other. The
    // former patch bounds the intersection and the union, the latter the difference.
    if (is_first) {
      is_inside = below;
      is_outside = operation == Operation::unite ? !above : !below;
    }
    if (is_inside) kept.common.push_back(patch);
    // A subtracted tool contributes the walls of its cut: its inner patches, facing the other way.
    const bool is_wall_of_cut = !is_first && operation == Operation::subtract;
    if (is_wall_of_cut ? is_inside : is_outside) kept.result.push_back(is_wall_of_cut ? turned_over(patch) : patch);
  }
  return true;
}

using OpenSide = std::array<double, 6>;  // coordinates of both ends of a facet's side, in its direction

// The open sides of a mesh, sorted. Empty if one is a side of several facets.
std::optional<std::vector<OpenSide>> border_of(const TriangleMesh& welded) {
  // An edge as the lower and the higher number of its vertices, 32 bits each, and true if the side runs from the lower
  // number.
  std::vector<std::pair<std::uint64_t, bool>> sides;
  sides.reserve(3 * welded.triangles.size());
  for (const auto& triangle : welded.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = triangle[k], b = triangle[(k + 1) % 3];
      sides.emplace_back(std::min(a, b) << 32 | std::max(a, b), a < b);
    }
  }
  std::sort(sides.begin(), sides.end());
  if (std::adjacent_find(sides.begin(), sides.end()) != sides.end()) return std::nullopt;
  std::vector<OpenSide> border;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (k + 1 < sides.size() && sides[k].first == sides[k + 1].first) {
      ++k;
      continue;
    }
    Vec3 from = welded.vertices[sides[k].first >> 32], to = welded.vertices[sides[k].first & 0xFFFFFFFFu];
    if (!sides[k].second) std::swap(from, to);
    border.push_back({from.x(), from.y(), from.z(), to.x(), to.y(), to.z()});
  }
  std::sort(border.begin(), border.end());
  return border;
}

bool has(const std::array<std::uint32_t, 3>& triangle, std::uint32_t vertex) {
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

// Moves `from` onto `to`. Does nothing if a facet would turn over, or if both vertices have other than two common
// neighbours: the surface would not stay a manifold.
void collapse(TriangleMesh& mesh, std::uint32_t from, std::uint32_t to) {
  std::set<std::uint32_t> beside_from, beside_to;
  for (const auto& triangle : mesh.triangles) {
    if (has(triangle, from)) beside_from.insert(triangle.begin(), triangle.end());
    if (has(triangle, to)) beside_to.insert(triangle.begin(), triangle.end());
    if (!has(triangle, from) || has(triangle, to)) continue;
    const auto corner = [&](std::size_t k) { return mesh.vertices[triangle[k]]; };
    const auto moved = [&](std::size_t k) { return mesh.vertices[triangle[k] == from ? to : triangle[k]]; };
    const Vec3 before = (corner(1) - corner(0)).cross(corner(2) - corner(0)),
               after = (moved(1) - moved(0)).cross(moved(2) - moved(0));
    if (!(before.dot(after) > 0)) return;
  }
  const auto in_common = std::count_if(beside_from.begin(), beside_from.end(),
                                       [&beside_to](std::uint32_t vertex) { return beside_to.contains(vertex); });
  if (in_common != 4) return;  // `from` and `to` themselves, and one neighbour on either side of the edge
  for (auto& triangle : mesh.triangles) std::replace(triangle.begin(), triangle.end(), from, to);
}

void erase_collapsed(TriangleMesh& mesh) {
  std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

// Collapses edges whose two ends became equal by rounding, and edges of a few float steps, whose facets have no
// computable normal. The facets beside a collapsed edge are removed.
TriangleMesh without_short_edges(const TriangleMesh& rounded) {
  constexpr double k_short = 5.0 * k_float_grain;  // mm
  TriangleMesh mesh = without_collapsed_facets(rounded);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      if (a < b && (mesh.vertices[a] - mesh.vertices[b]).squaredNorm() < k_short * k_short) edges.emplace_back(b, a);
    }
  }
  for (const auto& [from, to] : edges) {
    collapse(mesh, from, to);
    erase_collapsed(mesh);
  }
  return mesh;
}

struct FacetSide {
  std::uint32_t from, to, opposite;
};

FacetSide longest_side(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const auto length = [&](std::size_t k) {
    return (mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]]).squaredNorm();
  };
  std::size_t k = 0;
  for (std::size_t other = 1; other < 3; ++other) {
    if (length(other) > length(k)) k = other;
  }
  return {t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
}

Vec3 area_vector(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

// Height of a facet above its longest side.
double height(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const FacetSide base = longest_side(mesh, t);
  return area_vector(mesh, t).norm() / (mesh.vertices[base.to] - mesh.vertices[base.from]).norm();
}

// A facet of less height counts as flat, mm. It is so flat that a flip changes the shape of its neighbours by less than
// rounding does.
constexpr double k_flat = 0.1 * k_float_grain;

// Flips the diagonal between a flat facet and its neighbour across the longest side. Returns false without a change if
// one of the two new facets would be hardly higher (a neighbour that is as flat is flipped first), would face the other
// way, or if the new diagonal is already an edge.
bool flip_diagonal(TriangleMesh& mesh, std::array<std::uint32_t, 3>& flat) {
  constexpr double k_least_gain = 10.0;  // least factor by which the new facets are higher
  const auto [p, q, r] = longest_side(mesh, flat);
  const auto runs_back = [p = p, q = q](const auto& t) {
    return (t[0] == q && t[1] == p) || (t[1] == q && t[2] == p) || (t[2] == q && t[0] == p);
  };
  const auto beside = std::find_if(mesh.triangles.begin(), mesh.triangles.end(), runs_back);
  if (beside == mesh.triangles.end()) return false;
  // The corner of the neighbour opposite the common side p q.
  const std::uint32_t s = (*beside)[0] + (*beside)[1] + (*beside)[2] - p - q;
  const auto spans = [r = r, s](const auto& t) { return has(t, r) && has(t, s); };
  if (std::any_of(mesh.triangles.begin(), mesh.triangles.end(), spans)) return false;
  const std::array<std::uint32_t, 3> one{p, s, r}, other{s, q, r};
  const Vec3 outward = area_vector(mesh, *beside);
  const double needed = std::max(k_flat, k_least_gain * height(mesh, flat));
  for (const auto& made : {one, other})
    if (height(mesh, made) < needed || !(area_vector(mesh, made).dot(outward) > 0)) return false;
  flat = one;
  *beside = other;
  return true;
}

// Rounding may make a facet's three corners collinear, or nearly so. In a fan of such facets each flip enables the
// next, so the passes are repeated until one flips nothing.
void flip_flat_facets(TriangleMesh& mesh) {
  std::vector<std::size_t> flat;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    if (height(mesh, mesh.triangles[f]) < k_flat) flat.push_back(f);
  const auto flip = [&mesh](std::size_t f) { return flip_diagonal(mesh, mesh.triangles[f]); };
  while (std::erase_if(flat, flip) > 0) {
  }
}

// CGAL numbers its results in an order that depends on memory addresses. Sorting gives the same order of vertices and
// facets every time.
TriangleMesh in_order(TriangleMesh mesh) {
  struct NumberedVertex {
    Vec3 vertex;
    std::uint32_t index;
  };
  std::vector<NumberedVertex> order;
  order.reserve(mesh.vertices.size());
  for (std::uint32_t k = 0; k < mesh.vertices.size(); ++k) order.push_back({mesh.vertices[k], k});
  std::sort(order.begin(), order.end(), [](const NumberedVertex& a, const NumberedVertex& b) {
    const Vec3 &p = a.vertex, &q = b.vertex;
    return std::tuple(p.z(), p.y(), p.x()) < std::tuple(q.z(), q.y(), q.x());
  });
  std::vector<std::uint32_t> rank(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    rank[order[k].index] = k;
    mesh.vertices[k] = order[k].vertex;
  }
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& index : triangle) index = rank[index];
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  }
  mesh.triangles = sorted_by_vertex(
      mesh.triangles, mesh.vertices.size(), [](const auto& triangle) { return triangle[0]; }, std::less<>());
  return mesh;
}

// The result of a boolean, rounded to float and repaired.
TriangleMesh settled(const TriangleMesh& exact) { return in_order(without_short_edges(rounded_to_float(exact))); }

// `prepared`: a division computed in advance. It is used if the facets near the tool are still the same.
std::optional<BooleanResult> combined(const TriangleMesh& body, const TriangleMesh& tool, Operation operation,
                                      const Division* prepared = nullptr) {
  const Neighbourhood parts = neighbourhood(body, touched_by(tool, body));
  Division computed;
  if (prepared == nullptr || !are_same(prepared->near, parts.near)) {
    computed = divided(parts.near, tool);
    prepared = &computed;
  }
  const std::optional<CorefinedPair>& cut = prepared->cut;
  KeptPatches kept;
  if (!cut || !sort_patches(cut->first, tool, true, operation, kept) ||
      !sort_patches(cut->second, body, false, operation, kept))
    return std::nullopt;
  const TriangleMesh near = weld(together(kept.result));
  // The new facets replace the old ones, so both must have the same border.
  const auto border = border_of(near);
  if (!border || border != border_of(parts.near)) return std::nullopt;
  BooleanResult outcome{settled(together({near, parts.far})), enclosed_volume(in_order(weld(together(kept.common))))};
  flip_flat_facets(outcome.mesh);
  return outcome;
}

// Starts, on threads, the divisions of all tools that touch no facet touched by an earlier tool. The vertices are first
// put into the order that they have after the first cut, so that the facets found here equal those found then.
std::vector<Task<Division>> prepared_divisions(const TriangleMesh& body, const std::vector<TriangleMesh>& tools) {
  std::vector<Task<Division>> divisions(tools.size());
  if (tools.size() < 2) return divisions;
  const TriangleMesh ordered = settled(body);
  std::vector<bool> taken = touched_by(tools.front(), ordered);
  for (std::size_t k = 1; k < tools.size(); ++k) {
    const std::vector<bool> touched = touched_by(tools[k], ordered);
    bool is_apart = true;
    for (std::size_t f = 0; f < touched.size(); ++f) {
      is_apart = is_apart && !(touched[f] && taken[f]);
      taken[f] = taken[f] || touched[f];
    }
    if (!is_apart) continue;
    divisions[k] =
        run_async([near = neighbourhood(ordered, touched).near, &tool = tools[k]] { return divided(near, tool); });
  }
  return divisions;
}

}  // namespace

std::optional<BooleanResult> subtract(const TriangleMesh& body, const TriangleMesh& tool) {
  return combined(body, tool, Operation::subtract);
}
std::optional<CutBody> subtract_each(const TriangleMesh& body, const std::vector<TriangleMesh>& tools) {
  CutBody result{body, {}};
  std::vector<Task<Division>> divisions = prepared_divisions(body, tools);
  for (std::size_t k = 0; k < tools.size(); ++k) {
    const std::optional<Division> prepared = divisions[k].valid() ? std::optional(divisions[k].get()) : std::nullopt;
    auto outcome = combined(result.mesh, tools[k], Operation::subtract, prepared ? &*prepared : nullptr);
    if (!outcome) return std::nullopt;
    result.mesh = std::move(outcome->mesh);
    result.common_volumes.push_back(outcome->common_volume);
  }
  return result;
}
std::optional<BooleanResult> unite(const TriangleMesh& a, const TriangleMesh& b) {
  return combined(a, b, Operation::unite);
}

TriangleMesh together(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

}  // namespace fusee::solid
