#include "helical_solid/helical_blank.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "fusee/base.h"
#include "solid/caps.h"

// The outer surface is a fan of columns, one for each common direction of the normal. A column holds, upwards: the
// lower face's rim, P1's turns, the middle flange's two rings, P2's turns, the upper face's rim. From column to column
// a turn continues as the next row of its groove, and a ring as itself. Each strip between two columns is therefore a
// ladder of bands, section by section and rib by rib. A rib belongs to both the turn below it and the turn above it.
// Where a groove begins or ends, one side of a strip has two more corners, and a wall closes the groove's section.

namespace fusee::helical_solid {
namespace {

using Index = std::uint32_t;
using Facet = std::array<Index, 3>;

// Largest sagitta of the hub's facets, mm.
constexpr double k_hub_sagitta = 0.01;

// Fraction of a turn after which a ring leaves the outermost turn towards its end. Also the fraction of the filled rows
// after which the bulge over a channel declines.
constexpr double k_blend_from = 0.5;

// Beside a groove's end, at most a turn's columns divided by this are triangulated in one loop.
constexpr std::size_t k_loop_divisor = 4;

// Smooth step: 0 up to k_blend_from, 1 at share 1.
double blend(double share) {
  const double t = std::clamp((share - k_blend_from) / (1.0 - k_blend_from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// A closed ring that follows a groove's outermost turn, the lowest or highest. A turn of a spiral is open, so the ring
// leaves it in the half with the most clearance and returns to the place where the turn began. `outward`: distance of
// the ring from the pitch curve, mm.
std::vector<Vec2> ring_about(const Winding& winding, std::size_t columns, bool lowest, double outward) {
  const bool from_front = lowest != winding.falls;
  const std::size_t last = winding.rows.size() - 1;
  const auto row_at = [&](std::size_t k) -> const WindingRow& { return winding.rows[from_front ? k : last - k]; };
  const Vec2 gap = row_at(0).position - row_at(columns).position;  // between both ends of the turn
  const double turn = std::abs(row_at(columns).turn - row_at(0).turn);
  std::vector<Vec2> ring(columns);
  for (std::size_t k = 0; k < columns; ++k) {
    const WindingRow& row = row_at(k);
    const std::size_t column = winding.first_column + (from_front ? k : last - k);
    const double share = std::abs(row.turn - row_at(0).turn) / turn;
    ring[column % columns] = row.position + outward * row.normal + blend(share) * gap;
  }
  return ring;
}

class BlankBuilder {
 public:
  BlankBuilder(const Fan& fan, const HelicalSection& section, const solid::BodyLayout& layout,
               const RingHeights& heights)
      : fan_(fan),
        layout_(layout),
        heights_(heights),
        columns_(fan.columns()),
        groove_edge_(section.depth - 0.5 * layout.tendon_diameter) {
    const auto& below = section.walls.below;
    const auto& above = section.walls.above;
    for (std::size_t k = below.size(); k-- > 1;) section_.push_back({below[k].offset, -below[k].dz});
    for (std::size_t k = 1; k < above.size(); ++k) section_.push_back(above[k]);
  }

  solid::TriangleMesh build() {
    std::vector<Feature> ladder = add_features();
    for (std::size_t i = 0; i < columns_; ++i) add_strip(ladder, i);
    triangulate_bands();
    add_end_walls(ladder);
    add_faces();
    return std::move(mesh_);
  }

 private:
  // An element that rises through the strips: a ring, or a groove with all its turns.
  struct Feature {
    const Winding* winding = nullptr;  // the groove's; null: a ring
    Index first = 0;                   // first vertex of a ring
    std::vector<Index> rows = {};      // first vertex of each row of a groove
  };

  // One column's part of a ladder: a ring's vertex or a turn's section, from `low` to `high`.
  struct Segment {
    Index low = 0, high = 0;
  };

  Index add(const Vec2& plan, double z) {
    mesh_.vertices.emplace_back(plan.x(), plan.y(), z);
    return static_cast<Index>(mesh_.vertices.size() - 1);
  }

  Feature add_ring(const std::vector<Vec2>& plan, double z) {
    const Feature ring{nullptr, static_cast<Index>(mesh_.vertices.size()), {}};
    for (const Vec2& point : plan) add(point, z);
    rings_.push_back(ring.first);
    return ring;
  }

  // Adds the vertices of a groove. A filled row consists of the two groove edges only.
  Feature add_rows(const Winding& winding) {
    Feature groove{&winding, 0, {}};
    for (std::size_t j = 0; j < winding.rows.size(); ++j) {
      const WindingRow& row = winding.rows[j];
      groove.rows.push_back(static_cast<Index>(mesh_.vertices.size()));
      for (std::size_t k = 0; k < section_.size(); ++k) {
        const bool is_groove_edge = k == 0 || k + 1 == section_.size();
        if (winding.is_filled(j) && !is_groove_edge) continue;
        const solid::GroovePoint& point = section_[k];
        const double bulge = winding.is_filled(j) ? bulge_of(winding, j, k == 0) : 0.0;
        const double outward = point.offset + bulge - 0.5 * layout_.tendon_diameter;  // from the pitch curve
        add(row.position + outward * row.normal, row.height + point.dz);
      }
    }
    return groove;
  }

  // Distance by which a groove edge of a filled row projects beyond other rows.
  static double bulge_of(const Winding& winding, std::size_t row, bool low) {
    return (low ? winding.bulge_low : winding.bulge_high) * (1.0 - blend(winding.share_of_fill(row)));
  }

  // Adds the vertices of all features, from below.
  std::vector<Feature> add_features() {
    std::vector<Feature> all;
    const double foot = layout_.elephant_foot;
    if (foot > 0) all.push_back(add_ring(ring_about(fan_.p1, columns_, true, groove_edge_ - foot), 0.0));
    lowest_ = 0;
    all.push_back(
        add_ring(ring_about(fan_.p1, columns_, true, groove_edge_), foot > 0 ? solid::rise_of(layout_, foot) : 0.0));
    all.push_back(add_rows(fan_.p1));
    all.push_back(add_ring(ring_about(fan_.p1, columns_, false, groove_edge_), heights_.lower));
    all.push_back(add_ring(ring_about(fan_.p2, columns_, true, groove_edge_), heights_.upper));
    all.push_back(add_rows(fan_.p2));
    all.push_back(add_ring(ring_about(fan_.p2, columns_, false, groove_edge_), heights_.top));
    highest_ = all.back().first;
    return all;
  }

  // A row's section: its lowest and its highest vertex.
  Segment segment(const Feature& groove, std::size_t row) const {
    const Index first = groove.rows[row];
    return {first, first + (groove.winding->is_filled(row) ? 1 : static_cast<Index>(section_.size() - 1))};
  }

  // The rows of a groove in a column, upwards.
  std::vector<std::size_t> rows_in(const Winding& winding, std::size_t column) const {
    std::vector<std::size_t> rows;
    for (std::size_t j = (column + columns_ - winding.first_column) % columns_; j < winding.rows.size(); j += columns_)
      rows.push_back(j);
    if (winding.falls) std::reverse(rows.begin(), rows.end());
    return rows;
  }

  void triangle(Index a, Index b, Index c) { mesh_.triangles.push_back({a, b, c}); }

  // A band joins two columns of a strip: the left one (smaller angle) and the right one, both upwards between the
  // elements below and above. Seen from outside, the right column is on the right. A column in which a groove begins or
  // ends has two more corners.
  struct Band {
    std::vector<Index> left, right;
    bool is_plain() const { return left.size() == 2 && right.size() == 2; }
  };

  using Edge = std::pair<Index, Index>;
  using BandsByEdge = std::map<Edge, std::size_t>;

  // Cost of a triangle: the length of its last side, plus a large penalty if it does not face outwards.
  double cost_of(const Facet& facet) const {
    constexpr double k_fold = 1e6;      // mm, longer than all sides together
    constexpr double k_edge_on = 0.02;  // least cosine of the angle between the normal and outwards
    const Vec3 &p = mesh_.vertices[facet[0]], &q = mesh_.vertices[facet[1]], &r = mesh_.vertices[facet[2]];
    const Vec3 normal = (q - p).cross(r - p), outward(p.x(), p.y(), 0.0);
    const bool is_fold = !(normal.dot(outward) > k_edge_on * normal.norm() * outward.norm());
    return (r - p).norm() + (is_fold ? k_fold : 0.0);
  }

  // Triangulates a loop, counter-clockwise from outside, with the least total side length and no folded triangle
  // (dynamic programming over sub-polygons).
  void triangulate_loop(const std::vector<Index>& loop) {
    const std::size_t n = loop.size();
    // For the sub-polygon from corner i to corner j, at i n + j: its least cost, and the third corner of the triangle
    // on its side from i to j.
    std::vector<double> cost(n * n, 0.0);
    std::vector<std::size_t> middle(n * n, 0);
    for (std::size_t width = 2; width < n; ++width) {
      for (std::size_t i = 0; i + width < n; ++i) {
        const std::size_t j = i + width;
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t k = i + 1; k < j; ++k) {
          const double candidate = cost[i * n + k] + cost[k * n + j] + cost_of({loop[i], loop[k], loop[j]});
          if (candidate >= best) continue;
          best = candidate;
          middle[i * n + j] = k;
        }
        cost[i * n + j] = best;
      }
    }
    std::vector<Edge> open{{0, static_cast<Index>(n - 1)}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j < i + 2) continue;
      const auto k = static_cast<Index>(middle[i * n + j]);
      triangle(loop[i], loop[k], loop[j]);
      open.push_back({i, k});
      open.push_back({k, j});
    }
  }

  // Triangulates all bands. Most have four corners. A groove's end is a step in its column and may lean over
  // neighbouring strips, because points with one normal on two turns need not lie above one another. A band with a
  // groove's end is therefore triangulated in one loop with these neighbours.
  void triangulate_bands() {
    BandsByEdge with_left, with_right;
    std::vector<bool> triangulated(bands_.size(), false);
    for (std::size_t k = 0; k < bands_.size(); ++k) {
      if (!bands_[k].is_plain()) continue;
      with_left[{bands_[k].left.front(), bands_[k].left.back()}] = k;
      with_right[{bands_[k].right.front(), bands_[k].right.back()}] = k;
    }
    for (std::size_t k = 0; k < bands_.size(); ++k) {
      if (bands_[k].is_plain()) continue;
      triangulated[k] = true;
      triangulate_loop(loop_about(bands_[k], with_left, with_right, triangulated));
    }
    for (std::size_t k = 0; k < bands_.size(); ++k) {
      if (triangulated[k]) continue;
      const Band& band = bands_[k];
      triangulate_loop({band.left.front(), band.right.front(), band.right.back(), band.left.back()});
    }
  }

  // The corners of a band with a groove's end and of the neighbouring bands over which that end leans,
  // counter-clockwise. Marks these neighbours as triangulated.
  std::vector<Index> loop_about(const Band& band, const BandsByEdge& with_left, const BandsByEdge& with_right,
                                std::vector<bool>& triangulated) const {
    const bool on_right = band.right.size() > 2;
    const std::vector<Index>&ended = on_right ? band.right : band.left, &whole = on_right ? band.left : band.right;
    const BandsByEdge& bands = on_right ? with_right : with_left;
    std::vector<Index> lows = beside_end(ended, true), highs = beside_end(ended, false);
    for (Edge edge{whole.front(), whole.back()};;) {
      lows.push_back(edge.first);
      highs.push_back(edge.second);
      const auto found = bands.find(edge);
      if (found == bands.end() || triangulated[found->second] || lows.size() > columns_ / k_loop_divisor) break;
      if (is_beside(edge, ended, whole)) break;
      triangulated[found->second] = true;
      const std::vector<Index>& next = on_right ? bands_[found->second].left : bands_[found->second].right;
      edge = {next.front(), next.back()};
    }
    // The corners run away from the end's column: to the right if it is on the left, and otherwise to the left.
    if (on_right) std::swap(lows, highs);
    lows.insert(lows.end(), highs.rbegin(), highs.rend());
    return lows;
  }

  // The corners below and above a groove's end in its column, from the adjacent band that does not end in the ring.
  std::vector<Index> beside_end(const std::vector<Index>& ended, bool low) const {
    const bool under_ring = lies_under_ring(ended);
    if (low) return under_ring ? std::vector<Index>{ended[0]} : std::vector<Index>{ended[2], ended[1], ended[0]};
    return under_ring ? std::vector<Index>{ended[1], ended[2], ended[3]} : std::vector<Index>{ended[3]};
  }

  // True if the groove's end departs from this edge towards its own side by at least half a column.
  bool is_beside(const Edge& edge, const std::vector<Index>& ended, const std::vector<Index>& whole) const {
    const auto at = [&](Index v) { return mesh_.vertices[v]; };
    const bool under_ring = lies_under_ring(ended);
    const Vec3 step = under_ring ? Vec3(at(ended[3]) - at(whole.back())) : Vec3(at(ended[0]) - at(whole.front()));
    return std::all_of(ended.begin() + 1, ended.begin() + 3, [&](Index v) {
      const Vec3 low = at(edge.first), along = at(edge.second) - low;
      const Vec3 beside = low + (at(v).z() - low.z()) / along.z() * along;  // on the edge, at the height of v
      return (at(v) - beside).dot(step) > 0.5 * step.squaredNorm();
    });
  }

  // True if a groove's end lies under the ring that follows it, false if over it.
  bool lies_under_ring(const std::vector<Index>& ended) const {
    return std::any_of(rings_.begin(), rings_.end(), [&](Index first) {
      return ended.back() >= first && ended.back() < first + static_cast<Index>(columns_);
    });
  }

  // Adds all bands of a strip, from below.
  void add_strip(const std::vector<Feature>& ladder, std::size_t i) {
    const std::size_t next = (i + 1) % columns_;
    std::vector<Index> left, right;  // the present band's corners, upwards
    // Ends the present band at a feature and begins the next one above it.
    const auto pass_feature = [&](Segment on_left, Segment on_right) {
      left.push_back(on_left.low);
      right.push_back(on_right.low);
      if (left.size() > 1) bands_.push_back({left, right});
      left = {on_left.high};
      right = {on_right.high};
    };
    for (const Feature& feature : ladder) {
      if (feature.winding == nullptr) {
        const Index a = feature.first + static_cast<Index>(i), b = feature.first + static_cast<Index>(next);
        pass_feature({a, a}, {b, b});
        continue;
      }
      add_turns(feature, rows_in(*feature.winding, i), rows_in(*feature.winding, next), left, right, pass_feature);
    }
  }

  // Adds a groove's turns in a strip. `on_left`, `on_right`: its rows in both columns, upwards. A row at a groove's end
  // has no neighbour in the other column and adds two corners to the present band.
  void add_turns(const Feature& groove, const std::vector<std::size_t>& on_left,
                 const std::vector<std::size_t>& on_right, std::vector<Index>& left, std::vector<Index>& right,
                 const auto& pass_feature) {
    std::size_t l = 0, r = 0;
    const std::size_t last = groove.winding->rows.size() - 1;
    while (l < on_left.size() || r < on_right.size()) {
      if (l < on_left.size() && on_left[l] == last) {
        const Segment end = segment(groove, on_left[l++]);
        left.insert(left.end(), {end.low, end.high});
      } else if (r < on_right.size() && on_right[r] == 0) {
        const Segment end = segment(groove, on_right[r++]);
        right.insert(right.end(), {end.low, end.high});
      } else {
        demand(l < on_left.size() && r < on_right.size() && on_right[r] == on_left[l] + 1,
               "turns that do not continue");
        pass_feature(segment(groove, on_left[l]), segment(groove, on_right[r]));
        add_step(groove, on_left[l]);
        ++l;
        ++r;
      }
    }
  }

  // Adds the groove's surface from a row to the next one.
  void add_step(const Feature& groove, std::size_t row) {
    const Segment a = segment(groove, row), b = segment(groove, row + 1);
    if (groove.winding->is_filled(row) || groove.winding->is_filled(row + 1)) {
      triangle(a.low, b.low, b.high);
      triangle(a.low, b.high, a.high);
      return;
    }
    for (Index k = 0; a.low + k < a.high; ++k) {
      triangle(a.low + k, b.low + k, b.low + k + 1);
      triangle(a.low + k, b.low + k + 1, a.low + k + 1);
    }
  }

  // The section is convex towards the axis: a triangle fan from its lower edge point closes it.
  void add_end_walls(const std::vector<Feature>& ladder) {
    for (const Feature& groove : ladder) {
      if (groove.winding == nullptr) continue;
      const Segment begin = segment(groove, groove.winding->filled_front);
      const Segment end = segment(groove, groove.winding->rows.size() - 1 - groove.winding->filled_back);
      for (Index k = 1; begin.low + k < begin.high; ++k) triangle(begin.low, begin.low + k, begin.low + k + 1);
      for (Index k = 1; end.low + k < end.high; ++k) triangle(end.low, end.low + k + 1, end.low + k);
    }
  }

  std::vector<Index> ring_indices(Index first) const {
    std::vector<Index> indices;
    for (std::size_t i = 0; i < columns_; ++i) indices.push_back(first + static_cast<Index>(i));
    return indices;
  }
  std::vector<Index> loop_at(const Polygon& loop, double z) {
    std::vector<Index> indices;
    for (const Vec2& point : loop) indices.push_back(add(point, z));
    return indices;
  }

  // Fills loops[0] minus the other loops, all at one height.
  void face(const std::vector<std::vector<Index>>& loops, bool up) {
    std::vector<Polygon> polygons;
    std::vector<Index> index;
    for (const auto& loop : loops) {
      polygons.emplace_back();
      for (const Index v : loop) {
        polygons.back().push_back(mesh_.vertices[v].head<2>());
        index.push_back(v);
      }
    }
    for (const auto& [a, b, c] : solid::triangulate(polygons)) {
      if (up)
        triangle(index[a], index[b], index[c]);
      else
        triangle(index[a], index[c], index[b]);
    }
  }

  // Adds the wall between two levels of a counter-clockwise loop. `outward`: the solid is inside it.
  void wall(const std::vector<Index>& low, const std::vector<Index>& high, bool outward) {
    for (std::size_t i = 0; i < low.size(); ++i) {
      const std::size_t n = (i + 1) % low.size();
      if (outward) {
        triangle(low[i], low[n], high[n]);
        triangle(low[i], high[n], high[i]);
      } else {
        triangle(low[n], low[i], high[i]);
        triangle(low[n], high[i], high[n]);
      }
    }
  }

  std::vector<Polygon> bores() const {
    std::vector<Polygon> holes{layout_.bore.outline};
    holes.insert(holes.end(), layout_.bore.screw_holes.begin(), layout_.bore.screw_holes.end());
    for (Polygon& hole : holes) {
      if (signed_area(hole) < 0) std::reverse(hole.begin(), hole.end());
    }
    return holes;
  }

  // Adds the faces at both ends, the hub, and the walls of bore and screw holes.
  void add_faces() {
    std::vector<std::vector<Index>> below{ring_indices(lowest_)}, above;  // loops of the lowest and the highest face
    const double top = layout_.hub_radius > 0 ? heights_.hub_top : heights_.top;
    if (layout_.hub_radius > 0) {
      const Polygon circle = hub_circle();
      const std::vector<Index> foot = loop_at(circle, heights_.top), head = loop_at(circle, top);
      face({ring_indices(highest_), foot}, true);
      wall(foot, head, true);
      above.push_back(head);
    } else {
      above.push_back(ring_indices(highest_));
    }
    for (const Polygon& hole : bores()) {
      below.push_back(loop_at(hole, 0.0));
      above.push_back(loop_at(hole, top));
      wall(below.back(), above.back(), false);
    }
    face(below, false);
    face(above, true);
  }

  Polygon hub_circle() const {
    const double radius = layout_.hub_radius;
    const int facets = std::max(24, static_cast<int>(std::ceil(k_pi / elementary::acos(1.0 - k_hub_sagitta / radius))));
    Polygon circle;
    for (int k = 0; k < facets; ++k) circle.push_back(radius * unit(k_two_pi * (k + 0.5) / facets));
    return circle;
  }

  const Fan& fan_;
  const solid::BodyLayout& layout_;
  const RingHeights& heights_;
  std::size_t columns_;
  double groove_edge_;
  std::vector<solid::GroovePoint> section_;  // upwards, offsets from the floor
  solid::TriangleMesh mesh_;
  std::vector<Band> bands_;
  std::vector<Index> rings_;        // first vertex of each ring
  Index lowest_ = 0, highest_ = 0;  // first vertex of the lowest and of the highest ring
};

}  // namespace

Polygon rim_of(const Fan& fan, transmission::Side side, double groove_edge) {
  return side == transmission::Side::left ? ring_about(fan.p1, fan.columns(), true, groove_edge)
                                          : ring_about(fan.p2, fan.columns(), false, groove_edge);
}

double middle_step(const Fan& fan, double groove_edge) {
  const std::vector<Vec2> lower = ring_about(fan.p1, fan.columns(), false, groove_edge),
                          upper = ring_about(fan.p2, fan.columns(), true, groove_edge);
  double step = 0;
  for (std::size_t i = 0; i < fan.columns(); ++i) step = std::max(step, (upper[i] - lower[i]).dot(unit(fan.angles[i])));
  return step;
}

solid::TriangleMesh helical_blank(const Fan& fan, const HelicalSection& section, const solid::BodyLayout& layout,
                                  const RingHeights& heights) {
  return BlankBuilder(fan, section, layout, heights).build();
}

}  // namespace fusee::helical_solid
