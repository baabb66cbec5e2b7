/// \file
/// Checks for faults of a drawing that stop a workshop's machine: one Check each, with the layer, the line in the file
/// and the place.
///
/// Contours are the cut lines. In a drawing with fusee's layers these are CUT_*, P*_PITCH, P*_FLOOR, BORE, CHECK_10MM
/// and SHEET. In other drawings they are all layers except ENGRAVE, NOTES and MARK_*, whose lines may end and cross
/// anywhere.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/text.h"
#include "export/drawings/cut_shapes.h"
#include "export/drawings/end_points.h"
#include "export/drawings/plane_shapes.h"
#include "export/drawings/polygon_cgal.h"
#include "fusee/export.h"

namespace fusee::formats {
namespace {

constexpr double k_clean_feature = 1.0;  // mm, the narrowest feature that a laser cuts cleanly in common sheet
constexpr double k_resolution = 1e-6;    // mm, resolution of a drawing's coordinates

constexpr auto k_contour_layers =
    std::to_array<std::string_view>({"CUT_OUTER", "CUT_INNER", "P1_PITCH", "P2_PITCH", "P1_FLOOR", "P2_FLOOR", "BORE"});
constexpr std::string_view k_bore_layer = "BORE";  // its width is that of the shaft, however narrow
constexpr auto k_frame_layers = std::to_array<std::string_view>({"CHECK_10MM", "SHEET"});

template <std::size_t n>
bool among(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_mark_layer(std::string_view layer) {
  return layer == "ENGRAVE" || layer == "NOTES" || layer.starts_with("MARK_");
}

std::string location_text(const DrawingPath& path, const Vec2& point) {
  return fmt::format("layer {}, {} at line {}, at ({}, {}) mm", path.layer, path.entity, path.line,
                     rounded(point.x(), 6), rounded(point.y(), 6));
}

using Paths = std::vector<const DrawingPath*>;

Paths contours_of(const Drawing& drawing) {
  const bool has_fusee_layers = std::any_of(drawing.paths.begin(), drawing.paths.end(),
                                            [](const DrawingPath& p) { return among(k_contour_layers, p.layer); });
  Paths contours;
  for (const DrawingPath& path : drawing.paths) {
    if (path.points.empty()) continue;
    const bool named = among(k_contour_layers, path.layer) || among(k_frame_layers, path.layer);
    if (has_fusee_layers ? named : !is_mark_layer(path.layer)) contours.push_back(&path);
  }
  return contours;
}

// ---- Closed ---------------------------------------------------------------------------------------------------------

double gap_of(const DrawingPath& path) { return (path.points.front() - path.points.back()).norm(); }

/// True if a contour was meant to be closed: its gap is narrower than any cut feature and much shorter than its length.
bool almost_closes(const DrawingPath& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i) length += (path.points[i] - path.points[i - 1]).norm();
  return !path.closed && gap_of(path) < std::min(k_clean_feature, 0.5 * length);
}

Check check_contours_closed(const Paths& contours) {
  std::size_t open = 0;
  std::string where;
  for (const DrawingPath* path : contours) {
    if (path->closed || almost_closes(*path)) continue;
    if (open++ == 0) where = "open: " + location_text(*path, path->points.front());
  }
  return exactly("contours_closed", static_cast<double>(open), 0, "1", where);
}

Check check_ends_meet(const Paths& contours) {
  double widest = 0;
  std::string where;
  for (const DrawingPath* path : contours) {
    if (!almost_closes(*path)) continue;
    const double gap = gap_of(*path);
    if (gap <= widest) continue;
    widest = gap;
    where = "gap between " + location_text(*path, path->points.back()) +
            fmt::format(" and ({}, {}) mm", rounded(path->points.front().x(), 6), rounded(path->points.front().y(), 6));
  }
  return at_most("ends_meet", widest, k_joined, "mm", where);
}

// ---- Lines and crossings --------------------------------------------------------------------------------------------

/// One edge of a path. Its direction along the path is not kept.
struct Edge {
  Vec2 left;   ///< the end that precedes the other one, see precedes()
  Vec2 right;  ///< the other end
  const DrawingPath* path = nullptr;
  std::size_t index = 0;  ///< index along the path
  std::size_t last = 0;   ///< index of the path's last edge
};

/// True if a precedes b in the order of x, then y.
bool precedes(const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); }

/// The corners of a path, with repeated points merged.
Polygon corners_of(const DrawingPath& path) {
  Polygon points;
  points.reserve(path.points.size());
  for (const Vec2& p : path.points) {
    if (points.empty() || p != points.back()) points.push_back(p);
  }
  while (path.closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  return points;
}

void append_edges(std::vector<Edge>& edges, const DrawingPath& path) {
  const Polygon points = corners_of(path);
  if (points.size() < 2) return;
  const std::size_t count = path.closed ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2& a = points[i];
    const Vec2& b = points[(i + 1) % points.size()];
    edges.push_back({precedes(a, b) ? a : b, precedes(a, b) ? b : a, &path, i, count - 1});
  }
}

std::map<std::string, std::vector<Edge>> edges_by_layer(const Paths& paths) {
  std::map<std::string, std::vector<Edge>> layers;
  for (const DrawingPath* path : paths) append_edges(layers[path->layer], *path);
  return layers;
}

/// Removes repeated edges (the same two ends in either order) from `edges` and returns them.
std::vector<Edge> take_duplicates(std::vector<Edge>& edges) {
  EndPoints ends;
  std::set<std::pair<std::size_t, std::size_t>> seen;
  std::vector<Edge> once;
  std::vector<Edge> again;
  for (const Edge& edge : edges) {
    auto key = std::make_pair(ends.number(edge.left), ends.number(edge.right));
    if (key.first > key.second) std::swap(key.first, key.second);
    // Both ends of an edge shorter than k_joined have the same number. Such an edge repeats no other edge.
    const bool is_first = key.first == key.second || seen.insert(key).second;
    (is_first ? once : again).push_back(edge);
  }
  edges = std::move(once);
  return again;
}

struct Duplicates {
  Check check;
  std::set<const DrawingPath*> paths;  ///< paths of which every edge repeats an earlier one
};

Duplicates check_duplicates(const Drawing& drawing) {
  Paths all;
  // Paths in space are not compared: helical turns above one another have the same plan view.
  for (const DrawingPath& path : drawing.paths)
    if (!path.in_space) all.push_back(&path);
  std::size_t count = 0;
  std::string where;
  Duplicates duplicates;
  for (auto& [layer, edges] : edges_by_layer(all)) {
    const std::vector<Edge> repeated = take_duplicates(edges);
    std::map<const DrawingPath*, std::size_t> repeats;
    for (const Edge& edge : repeated) {
      const std::size_t edges_of_path = edge.last + 1;
      if (++repeats[edge.path] == edges_of_path) duplicates.paths.insert(edge.path);
    }
    if (count == 0 && !repeated.empty())
      where = "drawn twice: " +
              location_text(*repeated.front().path, 0.5 * (repeated.front().left + repeated.front().right));
    count += repeated.size();
  }
  duplicates.check = exactly("no_duplicate_lines", static_cast<double>(count), 0, "1", where);
  return duplicates;
}

bool within_box(const Edge& edge, const Vec2& p) {
  return p.x() >= edge.left.x() && p.x() <= edge.right.x() && p.y() >= std::min(edge.left.y(), edge.right.y()) &&
         p.y() <= std::max(edge.left.y(), edge.right.y());
}

/// True if the two edges have a common point.
bool are_touching(const Edge& a, const Edge& b) {
  const int a1 = orientation(b.left, b.right, a.left);
  const int a2 = orientation(b.left, b.right, a.right);
  const int b1 = orientation(a.left, a.right, b.left);
  const int b2 = orientation(a.left, a.right, b.right);
  if (a1 * a2 < 0 && b1 * b2 < 0) return true;
  return (a1 == 0 && within_box(b, a.left)) || (a2 == 0 && within_box(b, a.right)) ||
         (b1 == 0 && within_box(a, b.left)) || (b2 == 0 && within_box(a, b.right));
}

/// Neighbours along a path meet in one point. They are faulty only if the second runs back over the first.
bool folds_back(const Edge& a, const Edge& b) {
  if (orientation(a.left, a.right, b.left) != 0 || orientation(a.left, a.right, b.right) != 0) return false;
  return precedes(b.left, a.right) && precedes(a.left, b.right);
}

bool are_consecutive(const Edge& a, const Edge& b) {
  if (a.path != b.path) return false;
  const std::size_t distance = a.index > b.index ? a.index - b.index : b.index - a.index;
  const bool are_last_and_first = a.path->closed && distance == a.last;
  return distance == 1 || are_last_and_first;
}

/// The common point of two edges; of collinear ones the first common point.
Vec2 crossing_point(const Edge& a, const Edge& b) {
  const Vec2 u = a.right - a.left;
  const Vec2 v = b.right - b.left;
  const double determinant = cross(u, v);
  if (determinant == 0) return precedes(a.left, b.left) ? b.left : a.left;
  return a.left + u * std::clamp(cross(b.left - a.left, v) / determinant, 0.0, 1.0);
}

/// Two edges that touch but should not, if any. Sweep line of Shamos and Hoey: the line passes the edges in (x, y)
/// order and compares neighbours only, so n edges take n log n steps. With exact orientations the order along the line
/// is correct up to the first fault, where the sweep stops.
class Sweep {
 public:
  /// `within_paths`: also compare edges of the same path.
  Sweep(const std::vector<Edge>& edges, bool within_paths) : edges_(edges), within_paths_(within_paths) {}

  std::optional<std::pair<Edge, Edge>> first_fault() {
    struct Event {
      Vec2 point;
      bool ends;
      std::size_t edge;
    };
    std::vector<Event> events;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      events.push_back({edges_[i].left, false, i});
      events.push_back({edges_[i].right, true, i});
    }
    // At one point, edges begin before others end, so that edges which only touch there are compared.
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
      if (a.point != b.point) return precedes(a.point, b.point);
      return std::make_pair(a.ends, a.edge) < std::make_pair(b.ends, b.edge);
    });
    std::vector<Line::iterator> position_of(edges_.size());
    for (const Event& event : events) {
      if (!event.ends) {
        position_of[event.edge] = line_.insert(event.edge).first;
        const auto at = position_of[event.edge];
        if (at != line_.begin() && fault(*std::prev(at), *at)) return fault_;
        if (std::next(at) != line_.end() && fault(*at, *std::next(at))) return fault_;
      } else {
        const auto next = line_.erase(position_of[event.edge]);
        if (next != line_.begin() && next != line_.end() && fault(*std::prev(next), *next)) return fault_;
      }
    }
    return std::nullopt;
  }

 private:
  /// True if edge i is below edge j where both are on the line.
  struct EdgeOrder {
    const std::vector<Edge>* edges;
    bool operator()(std::size_t i, std::size_t j) const {
      const Edge& a = (*edges)[i];
      const Edge& b = (*edges)[j];
      if (i == j) return false;
      const bool a_first = !precedes(b.left, a.left);
      const Edge& first = a_first ? a : b;
      const Edge& second = a_first ? b : a;
      int side = orientation(first.left, first.right, second.left);
      if (side == 0) side = orientation(first.left, first.right, second.right);
      if (side == 0) return i < j;
      return (side > 0) == a_first;
    }
  };
  /// The edges that the sweep line crosses, by index, from bottom to top.
  using Line = std::set<std::size_t, EdgeOrder>;

  bool fault(std::size_t i, std::size_t j) {
    const Edge& a = edges_[i];
    const Edge& b = edges_[j];
    if (a.path == b.path && !within_paths_) return false;
    if (!(are_consecutive(a, b) ? folds_back(a, b) : are_touching(a, b))) return false;
    fault_ = {a, b};
    return true;
  }

  const std::vector<Edge>& edges_;
  bool within_paths_;
  Line line_{EdgeOrder{&edges_}};
  std::pair<Edge, Edge> fault_;
};

/// True if the path turns to one side at every corner, once round. Such a path does not meet itself. Most paths of a
/// pulley are convex, which avoids the sweep.
bool is_convex(const DrawingPath& path) {
  const Polygon points = corners_of(path);
  const std::size_t n = points.size();
  if (!path.closed || n < 3) return false;
  const auto corner = [&](std::size_t i) -> const Vec2& { return points[i % n]; };
  const int side = orientation(corner(0), corner(1), corner(2));
  int reversals = 0;  // changes of direction along x: two in each turn
  for (std::size_t i = 0; i < n; ++i) {
    if (side == 0 || orientation(corner(i), corner(i + 1), corner(i + 2)) != side) return false;
    reversals += precedes(corner(i), corner(i + 1)) != precedes(corner(i + 1), corner(i + 2)) ? 1 : 0;
  }
  return reversals == 2;
}

std::optional<std::pair<Edge, Edge>> fault_within(const DrawingPath& path) {
  if (is_convex(path)) return std::nullopt;
  std::vector<Edge> edges;
  append_edges(edges, path);
  return Sweep(edges, /*within_paths=*/true).first_fault();
}

/// True if the boxes of all paths are apart, so that no two paths meet. Gives up with false for very many paths.
bool are_apart(const Paths& paths) {
  std::size_t comparisons_left = 100'000;
  std::vector<Box2d> boxes;
  for (const DrawingPath* path : paths) boxes.push_back(bounding_box(path->points));
  std::sort(boxes.begin(), boxes.end(), [](const Box2d& a, const Box2d& b) { return a.low.x() < b.low.x(); });
  for (auto a = boxes.begin(); a != boxes.end(); ++a) {
    for (auto b = std::next(a); b != boxes.end() && b->low.x() <= a->high.x(); ++b) {
      if (comparisons_left-- == 0 || (b->low.y() <= a->high.y() && a->low.y() <= b->high.y())) return false;
    }
  }
  return true;
}

std::optional<std::pair<Edge, Edge>> fault_between(const Paths& paths) {
  if (are_apart(paths)) return std::nullopt;
  std::vector<Edge> edges;
  for (const DrawingPath* path : paths) append_edges(edges, *path);
  take_duplicates(edges);  // they have their own check
  return Sweep(edges, /*within_paths=*/false).first_fault();
}

struct CrossingChecks {
  Check self;
  Check mutual;
};

/// True if the ends of a contour almost meet and overshoot each other: the crossing is within twice their gap. The check
/// ends_meet reports such a contour.
bool is_overshoot(const DrawingPath& path, const Vec2& crossing) {
  const double reach = 2 * gap_of(path);
  return almost_closes(path) &&
         ((path.points.front() - crossing).norm() <= reach || (path.points.back() - crossing).norm() <= reach);
}

/// Checks each contour alone, and then those without faults together, layer by layer.
CrossingChecks check_crossings(const Paths& contours) {
  std::size_t crossed = 0;
  std::string self_where;
  std::map<std::string, Paths> valid_paths;  // by layer
  for (const DrawingPath* path : contours) {
    const auto fault = fault_within(*path);
    if (fault && is_overshoot(*path, crossing_point(fault->first, fault->second))) continue;
    if (!fault) valid_paths[path->layer].push_back(path);
    if (fault && crossed++ == 0)
      self_where = "crosses or touches itself: " + location_text(*path, crossing_point(fault->first, fault->second));
  }
  std::size_t layers = 0;
  std::string mutual_where;
  for (const auto& [layer, paths] : valid_paths) {
    const auto fault = fault_between(paths);
    if (!fault || layers++ > 0) continue;
    mutual_where = location_text(*fault->first.path, crossing_point(fault->first, fault->second)) +
                   fmt::format(" meets the {} at line {}", fault->second.path->entity, fault->second.path->line);
  }
  return {exactly("no_self_crossing", static_cast<double>(crossed), 0, "1", self_where),
          exactly("no_crossing_contours", static_cast<double>(layers), 0, "1", mutual_where)};
}

// ---- Sizes ----------------------------------------------------------------------------------------------------------

/// Least distance of two parallel lines that contain the polygon (rotating calipers on its hull).
double least_width(const Polygon& polygon) {
  const Polygon hull = convex_hull(polygon);
  if (hull.size() < 3) return 0;
  double least = std::numeric_limits<double>::infinity();
  std::size_t farthest = 1;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
    const auto distance = [&](std::size_t k) { return cross(edge, hull[k % hull.size()] - hull[i]); };
    for (std::size_t steps = 0; steps < hull.size() && distance(farthest + 1) > distance(farthest); ++steps) ++farthest;
    least = std::min(least, distance(farthest));
  }
  return least;
}

/// Empty if no closed contour has a width.
std::optional<Check> check_smallest_feature(const Paths& contours) {
  double least = std::numeric_limits<double>::infinity();
  const DrawingPath* narrow = nullptr;
  for (const DrawingPath* path : contours) {
    if (!path->closed || path->layer == k_bore_layer) continue;
    const double width = path->diameter ? *path->diameter : least_width(path->points);
    if (width >= least) continue;
    least = width;
    narrow = path;
  }
  if (narrow == nullptr) return std::nullopt;
  return at_least("smallest_feature", least, k_clean_feature - k_resolution, "mm",
                  "narrow: " + location_text(*narrow, narrow->points.front()));
}

// ---- Inside ---------------------------------------------------------------------------------------------------------

struct BoxedPath {
  const DrawingPath* path;
  Box2d box;
};

std::vector<BoxedPath> boxed_paths(const Drawing& drawing, std::string_view layer) {
  std::vector<BoxedPath> result;
  for (const DrawingPath& path : drawing.paths) {
    if (path.layer == layer && !path.points.empty()) result.push_back({&path, bounding_box(path.points)});
  }
  return result;
}

bool box_within(const Box2d& inner, const Box2d& outer) {
  return (inner.low - outer.low).minCoeff() >= -k_resolution && (outer.high - inner.high).minCoeff() >= -k_resolution;
}

/// Each contour of layer `inner` must lie within one of layer `outer`, if the drawing has such a layer.
struct RequiredNesting {
  std::string_view inner;
  std::string_view outer;
};
constexpr auto k_required_nesting = std::to_array<RequiredNesting>({{"CUT_INNER", "CUT_OUTER"},
                                                                    {"ENGRAVE", "CUT_OUTER"},
                                                                    {"CUT_OUTER", "SHEET"},
                                                                    {"CHECK_10MM", "SHEET"},
                                                                    {"BORE", "P1_FLOOR"},
                                                                    {"BORE", "P2_FLOOR"},
                                                                    {"P1_FLOOR", "P1_PITCH"},
                                                                    {"P2_FLOOR", "P2_PITCH"}});

Check check_inside(const Drawing& drawing) {
  // Bound on comparisons of points and edges: more than any drawing that can be cut requires.
  std::size_t budget = 300'000'000;
  std::size_t outside = 0;
  std::string where;
  for (const RequiredNesting& pair : k_required_nesting) {
    const std::vector<BoxedPath> outers = boxed_paths(drawing, pair.outer);
    if (outers.empty()) continue;
    for (const BoxedPath& inner : boxed_paths(drawing, pair.inner)) {
      const bool is_inside = std::any_of(outers.begin(), outers.end(), [&](const BoxedPath& outer) {
        budget -= std::min(budget, std::size_t{1});
        if (budget == 0 || !box_within(inner.box, outer.box)) return false;
        if (pair.outer == "SHEET") return true;  // a rectangle: its box is sufficient
        budget -= std::min(budget, inner.path->points.size() * outer.path->points.size());
        return budget > 0 && std::all_of(inner.path->points.begin(), inner.path->points.end(),
                                         [&](const Vec2& p) { return contains(outer.path->points, p); });
      });
      if (budget == 0)
        return exactly("nothing_outside", static_cast<double>(outside + 1), 0, "1",
                       "the drawing has too many contours to check");
      if (is_inside || outside++ > 0) continue;
      where = fmt::format("not inside {}: {}", pair.outer, location_text(*inner.path, inner.path->points.front()));
    }
  }
  return exactly("nothing_outside", static_cast<double>(outside), 0, "1", where);
}

std::string none_to_cut(const Drawing& drawing) {
  std::string text = "the drawing has no lines to cut";
  for (const std::string& kind : drawing.ignored)
    text += (&kind == &drawing.ignored.front() ? ", and these are not read: " : ", ") + kind;
  return text;
}

Check check_undrawn(const Drawing& drawing) {
  return exactly("undrawn_entities", static_cast<double>(drawing.undrawn), 0, "1",
                 fmt::format("line {}: {}", drawing.first_undrawn.line, drawing.first_undrawn.why));
}

}  // namespace

std::vector<Check> check_drawing(const Drawing& drawing) {
  const Duplicates duplicates = check_duplicates(drawing);
  Paths contours = contours_of(drawing);
  std::erase_if(contours, [&](const DrawingPath* path) { return duplicates.paths.count(path) > 0; });
  std::vector<Check> checks = {check_undrawn(drawing)};
  // A drawing whose entities were all undrawable has no contours and already one fault.
  if (!contours.empty() || drawing.undrawn == 0) {
    checks.push_back(at_least("contours", static_cast<double>(contours.size()), 1, "1", none_to_cut(drawing)));
  }
  checks.push_back(check_contours_closed(contours));
  checks.push_back(check_ends_meet(contours));
  checks.push_back(duplicates.check);
  CrossingChecks crossings = check_crossings(contours);
  checks.push_back(std::move(crossings.self));
  checks.push_back(std::move(crossings.mutual));
  if (auto feature = check_smallest_feature(contours)) checks.push_back(std::move(*feature));
  checks.push_back(check_inside(drawing));
  return checks;
}

}  // namespace fusee::formats
