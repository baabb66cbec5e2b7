#include "export/step/skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "export/step/grain.h"
#include "export/step/helical_curve.h"
#include "export/step/normal_spline.h"
#include "fusee/base.h"
#include "helical_solid/helical_plan.h"
#include "solid/heights.h"

// The outer surface consists of strands: closed rings, and the corners of both grooves' sections over all turns. Marks
// are the directions of the normal at which a groove ends, and some between. A strand's place number j is at mark j mod
// the number of marks, counted over all turns. Between marks all strands are splines on one knot vector. Between two
// vertically adjacent strands lie cells. Cells that continue across a mark form one face.
//
// Beyond a groove's end its two edges continue as far as the part is filled, and then to the straight between the
// strands below and above. There, at one more mark, they end on the side of the face that continues.

namespace fusee::formats {
namespace {

constexpr double k_floor_tolerance = 6e-5;  // of grooves, mm
constexpr double k_other_tolerance = 2e-3;  // of rings, and of groove edges beyond their groove, mm
/// Largest error of offsets by the normals, mm.
constexpr double k_normal_tolerance = 1e-5;
constexpr double k_slope_step = 1e-4;  // of one-sided differences, rad
constexpr double k_same_mark = 1e-6;   // rad
/// Approximate turn from the end of a groove's fill to the end of its edges.
constexpr double k_run = radians(45), k_shortest_run = radians(25), k_longest_run = radians(75);
/// Groove edges end before they reach their groove again.
constexpr double k_furthest_end = radians(340);
constexpr double k_widest_face = radians(190);
/// A wide face is divided at a mark that is this close to its middle, if there is one.
constexpr double k_near_middle = radians(30);
/// Largest effect of rounding poles to the resolution, mm.
constexpr double k_bent = 4e-6;

/// A corner of the section, relative to the tendon's centre line, and the curve to the next one.
struct SectionCorner {
  double outward = 0, dz = 0;          ///< along the normal and along the axis, mm
  bool arc = false;                    ///< false: a straight to the next corner
  double arc_outward = 0, arc_dz = 0;  ///< where the arc's end tangents meet: its middle pole
  double weight = 1;                   ///< of that pole
};

std::vector<SectionCorner> section_corners(const helical_solid::HelicalSection& section, const Mechanism& mechanism) {
  const double tendon_radius = 0.5 * mechanism.tendon.diameter;
  const solid::GrooveWalls& walls = section.walls;
  std::vector<SectionCorner> corners{{walls.below.back().offset - tendon_radius, -walls.below_width()}};
  const auto seat = seat_of(walls, mechanism);
  if (seat) {
    const std::vector<double> angles = seat->angles();
    const auto on_arc = [&](double angle, double radius) {
      return Vec2(seat->radius - tendon_radius - radius * elementary::cos(angle), radius * elementary::sin(angle));
    };
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const Vec2 place = on_arc(angles[i], seat->radius);
      SectionCorner corner{place.x(), place.y()};
      if (i + 1 < angles.size()) {
        const double half_turn = 0.5 * (angles[i + 1] - angles[i]);
        const Vec2 tip = on_arc(angles[i] + half_turn, seat->radius / elementary::cos(half_turn));
        corner.arc = true;
        corner.arc_outward = tip.x();
        corner.arc_dz = tip.y();
        corner.weight = elementary::cos(half_turn);
      }
      corners.push_back(corner);
    }
  } else {
    for (std::size_t k = walls.below.size() - 1; k-- > 1;)
      corners.push_back({walls.below[k].offset - tendon_radius, -walls.below[k].dz});
    for (std::size_t k = 1; k + 1 < walls.above.size(); ++k)
      corners.push_back({walls.above[k].offset - tendon_radius, walls.above[k].dz});
  }
  corners.push_back({walls.above.back().offset - tendon_radius, walls.above_width()});
  return corners;
}

/// A closed ring at the height z about a groove's lowest or highest turn, at the distance `outward` from its centre line.
struct RimRing {
  std::size_t groove = 0;
  bool lowest = true;
  double outward = 0;  ///< mm
  double z = 0;        ///< mm
};

/// A ring, or a corner of a groove's section.
struct Strand {
  int groove = -1;          ///< 0 or 1; −1: a ring
  std::size_t number = 0;   ///< number of the ring or of the corner
  int first = 0, last = 0;  ///< first and last place
};

/// A place of a strand, and its piece from there to the next one.
struct Place {
  std::size_t strand = 0;
  int at = 0;  ///< place number

  bool operator<(const Place& other) const { return std::pair(strand, at) < std::pair(other.strand, other.at); }
  bool operator==(const Place& other) const { return strand == other.strand && at == other.at; }
};

/// The positions of a groove's ends and edges.
struct GrooveExtent {
  int begin = 0, end = 0;                                ///< places of its ends
  int groove_edges_from = 0, groove_edges_to = 0;        ///< places of its edges' ends
  double groove_edges_first = 0, groove_edges_last = 0;  ///< turns of its edges' ends
  double follow_first = 0, follow_last = 0;              ///< turns up to which the edges follow the groove
  std::size_t strand = 0;                                ///< first strand of its section
  std::size_t ring_below = 0, ring_above = 0;            ///< strands
  std::vector<double> cuts;                              ///< directions at which adjacent faces end
};

/// The range between two marks, with the curves of all strands there.
struct Sector {
  double from = 0, to = 0;  ///< directions, rad
  SplineBundle spline;
  /// Columns of `spline` by strand and place: groove edges past their ends, rings, and grooves' curves (strand of the
  /// first corner).
  std::map<Place, Eigen::Index> columns;
};

/// The surface between two adjacent strands in one sector.
struct Cell {
  std::size_t sector = 0;
  Place low, high;
  bool ends_before = true, ends_after = true;  ///< false: its face continues across that mark
};

class SkinBuilder {
 public:
  explicit SkinBuilder(const Product& product)
      : mechanism_(product.joint.mechanism),
        plan_(*product.helix->pulley.plan),
        layout_(product.pulley.layout),
        corners_(section_corners(plan_.section, mechanism_)),
        groove_edge_(corners_.front().outward),
        grooves_{{HelicalGroove(product.helix->synthesis.sides[0].spiral, product.helix->pulley.p1, plan_.fan.p1),
                  HelicalGroove(product.helix->synthesis.sides[1].spiral, product.helix->pulley.p2, plan_.fan.p2)}} {}

  StepSkin build() {
    lay_strands();
    for (std::size_t s = 0; s < marks_.size(); ++s) fit_sector(s);
    find_cells();
    find_corners();
    add_faces();
    for (std::size_t g = 0; g < 2; ++g) {
      add_end_wall(g, extents_[g].begin, 1.0);
      add_end_wall(g, extents_[g].end, -1.0);
    }
    add_caps();
    return std::move(skin_);
  }

 private:
  using Row = Eigen::RowVectorXd;

  // ---- marks and strands ----

  /// The turn without whole turns, counted from the begin of groove P1.
  double direction_of(double turn) const {
    const double base = grooves_[0].begin();
    return turn - k_two_pi * std::floor((turn - base + k_same_mark) / k_two_pi);
  }
  /// Number of marks, and of sectors.
  int count() const { return static_cast<int>(marks_.size()); }
  std::size_t sector_of(int place) const { return static_cast<std::size_t>(((place % count()) + count()) % count()); }
  /// Whole turns before a place.
  int turns_of(int place) const { return (place - static_cast<int>(sector_of(place))) / count(); }
  double turn_at(int place) const { return marks_[sector_of(place)] + k_two_pi * turns_of(place); }

  int place_of(double turn) const {
    const double direction = direction_of(turn);
    const auto near = std::min_element(marks_.begin(), marks_.end(), [&](double a, double b) {
      return std::abs(a - direction) < std::abs(b - direction);
    });
    return static_cast<int>(near - marks_.begin()) + count() * static_cast<int>(std::lround((turn - *near) / k_two_pi));
  }

  /// Adds a mark, unless one is there. Returns its direction.
  double mark(double turn) {
    const double direction = direction_of(turn);
    for (const double known : marks_) {
      if (std::abs(known - direction) < k_same_mark) return known;
    }
    marks_.push_back(direction);
    return direction;
  }

  /// A turn at which groove edges end, past `from`. `onwards`: +1 beyond the last end of the groove, −1 before the first.
  double groove_edges_end(double end, double from, double onwards) {
    const double furthest = end + onwards * k_furthest_end;
    for (const double known : marks_) {
      double past = onwards * (known - from);
      past -= k_two_pi * std::floor(past / k_two_pi);
      if (past > k_shortest_run && past < k_longest_run && onwards * (furthest - from) > past)
        return from + onwards * past;
    }
    const double turn = onwards > 0 ? std::min(from + k_run, furthest) : std::max(from - k_run, furthest);
    mark(turn);
    return turn;
  }

  /// Chooses the directions at which faces beside a groove end, so that no face is wider than k_widest_face.
  void add_cuts(GrooveExtent& extent, const HelicalGroove& groove) {
    extent.cuts = {mark(groove.begin())};
    for (std::size_t i = 0; i < extent.cuts.size();) {
      std::sort(extent.cuts.begin(), extent.cuts.end());
      const double from = extent.cuts[i];
      const double to = i + 1 < extent.cuts.size() ? extent.cuts[i + 1] : extent.cuts.front() + k_two_pi;
      if (to - from < k_widest_face) {
        ++i;
        continue;
      }
      const double middle = 0.5 * (from + to);
      double best = k_near_middle;
      double cut = direction_of(middle);
      for (const double known : marks_) {
        const double away = std::abs(std::remainder(known - middle, k_two_pi));
        if (away >= best) continue;
        best = away;
        cut = known;
      }
      extent.cuts.push_back(mark(cut));
    }
  }

  void lay_strands() {
    for (const HelicalGroove& groove : grooves_) {
      mark(groove.begin());
      mark(groove.end());
    }
    for (std::size_t g = 0; g < 2; ++g) {
      GrooveExtent& extent = extents_[g];
      const HelicalGroove& groove = grooves_[g];
      const double longest = k_furthest_end - k_shortest_run;
      extent.follow_last = std::min(groove.filled_to(), groove.end() + longest);
      extent.follow_first = std::max(groove.filled_from(), groove.begin() - longest);
      extent.groove_edges_last = groove_edges_end(groove.end(), extent.follow_last, 1.0);
      extent.groove_edges_first = groove_edges_end(groove.begin(), extent.follow_first, -1.0);
    }
    for (std::size_t g = 0; g < 2; ++g) add_cuts(extents_[g], grooves_[g]);
    std::sort(marks_.begin(), marks_.end());

    const double foot = layout_.elephant_foot;
    if (foot > 0) add_ring({0, true, groove_edge_ - foot, 0});
    extents_[0].ring_below = add_ring({0, true, groove_edge_, foot > 0 ? solid::rise_of(layout_, foot) : 0.0});
    add_groove(0);
    extents_[0].ring_above = add_ring({0, false, groove_edge_, plan_.heights.lower});
    extents_[1].ring_below = add_ring({1, true, groove_edge_, plan_.heights.upper});
    add_groove(1);
    extents_[1].ring_above = add_ring({1, false, groove_edge_, plan_.heights.top});
  }

  std::size_t add_ring(const RimRing& ring) {
    rings_.push_back(ring);
    strands_.push_back({-1, rings_.size() - 1, 0, count()});
    return strands_.size() - 1;
  }

  void add_groove(std::size_t g) {
    GrooveExtent& extent = extents_[g];
    extent.begin = place_of(grooves_[g].begin());
    extent.end = place_of(grooves_[g].end());
    extent.groove_edges_from = place_of(extent.groove_edges_first);
    extent.groove_edges_to = place_of(extent.groove_edges_last);
    extent.strand = strands_.size();
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const bool is_groove_edge = k == 0 || k + 1 == corners_.size();
      strands_.push_back({static_cast<int>(g), k, is_groove_edge ? extent.groove_edges_from : extent.begin,
                          is_groove_edge ? extent.groove_edges_to : extent.end});
    }
  }

  bool is_ring(std::size_t strand) const { return strands_[strand].groove < 0; }
  bool in_groove(std::size_t g, int place) const { return place >= extents_[g].begin && place < extents_[g].end; }
  std::size_t low_groove_edge(std::size_t g) const { return extents_[g].strand; }
  std::size_t high_groove_edge(std::size_t g) const { return extents_[g].strand + corners_.size() - 1; }

  Place place(std::size_t strand, int at) const {
    return {strand, is_ring(strand) ? static_cast<int>(sector_of(at)) : at};
  }
  Place next(const Place& here) const { return place(here.strand, here.at + 1); }

  /// The strands in a sector, upwards. Grooves descend as they turn.
  std::vector<Place> stack_in(std::size_t sector) const {
    std::vector<Place> stack;
    for (std::size_t strand = 0; strand < strands_.size(); ++strand) {
      if (is_ring(strand)) {
        stack.push_back({strand, static_cast<int>(sector)});
        continue;
      }
      const auto g = static_cast<std::size_t>(strands_[strand].groove);
      if (strand != low_groove_edge(g)) continue;
      for (int at = extents_[g].groove_edges_to - 1; at >= extents_[g].groove_edges_from; --at) {
        if (sector_of(at) != sector) continue;
        for (std::size_t k = 0; k < corners_.size(); ++k) {
          const bool is_groove_edge = k == 0 || k + 1 == corners_.size();
          if (is_groove_edge || in_groove(g, at)) stack.push_back({strand + k, at});
        }
      }
    }
    return stack;
  }

  // ---- curves ----

  Vec3 ring_at(std::size_t strand, double direction) const {
    const RimRing& ring = rings_[strands_[strand].number];
    const Vec2 point = grooves_[ring.groove].ring(direction, ring.lowest, ring.outward);
    return {point.x(), point.y(), ring.z};
  }

  Vec3 groove_edge_at(std::size_t g, double turn, bool low, double bulge = 0) const {
    const SectionCorner& corner = low ? corners_.front() : corners_.back();
    const Vec2 out = (corner.outward + bulge) * unit(turn);
    return grooves_[g].at(turn) + Vec3(out.x(), out.y(), corner.dz);
  }

  /// Points of the strands below and above the groove edges beyond their groove's end. `back`: beyond the last end,
  /// otherwise before the first.
  std::pair<Vec3, Vec3> neighbours(std::size_t g, double turn, bool back) const {
    if (back) return {ring_at(extents_[g].ring_below, turn), groove_edge_at(g, turn - k_two_pi, true)};
    return {groove_edge_at(g, turn + k_two_pi, false), ring_at(extents_[g].ring_above, turn)};
  }

  /// The height at which a groove edge ends, relative to its neighbours: 0 at the lower one, 1 at the upper one.
  double height_share(std::size_t g, bool low, bool back) const {
    const double turn = back ? extents_[g].follow_last : extents_[g].follow_first;
    const auto [below, above] = neighbours(g, turn, back);
    return (groove_edge_at(g, turn, low).z() - below.z()) / (above.z() - below.z());
  }

  /// A groove edge beyond its groove's end: it moves from the groove's course to the straight between both neighbours.
  Vec3 free_groove_edge(std::size_t g, double turn, bool low) const {
    const HelicalGroove& groove = grooves_[g];
    const bool back = turn > 0.5 * (groove.begin() + groove.end());
    const double from = back ? extents_[g].follow_last : extents_[g].follow_first;
    const double to = back ? extents_[g].groove_edges_last : extents_[g].groove_edges_first;
    const double transition = smooth_step((turn - from) / (to - from));
    const auto [below, above] = neighbours(g, turn, back);
    const double share = height_share(g, low, back);
    return (1.0 - transition) * groove_edge_at(g, turn, low, groove.bulge(turn, low)) +
           transition * ((1.0 - share) * below + share * above);
  }

  void fit_sector(std::size_t s) {
    Sector sector{marks_[s], s + 1 < marks_.size() ? marks_[s + 1] : marks_.front() + k_two_pi, {}, {}};
    struct Column {
      Place place;
      double tolerance = 0;
    };
    std::vector<Column> columns;
    for (const Place& here : stack_in(s)) {
      const Strand& strand = strands_[here.strand];
      const bool is_in_groove = strand.groove >= 0 && in_groove(static_cast<std::size_t>(strand.groove), here.at);
      if (is_in_groove && strand.number > 0) continue;
      columns.push_back({here, is_in_groove ? k_floor_tolerance : k_other_tolerance});
      sector.columns[here] = 2 + 3 * static_cast<Eigen::Index>(columns.size() - 1);
    }
    SplineTarget target;
    target.at = [&](double psi) {
      Row row(2 + 3 * static_cast<Eigen::Index>(columns.size()));
      row.head<2>() = unit(psi).transpose();
      for (std::size_t k = 0; k < columns.size(); ++k)
        row.segment<3>(2 + 3 * static_cast<Eigen::Index>(k)) = base_at(columns[k].place, psi).transpose();
      return row;
    };
    target.slope = [&](double psi) -> Row {
      const double step = std::abs(psi - sector.from) < std::abs(psi - sector.to) ? k_slope_step : -k_slope_step;
      // The one-sided difference of second order.
      return (4.0 * target.at(psi + step) - 3.0 * target.at(psi) - target.at(psi + 2.0 * step)) / (2.0 * step);
    };
    const double reach = std::max(std::abs(groove_edge_), 0.5 * mechanism_.tendon.diameter);
    target.error = [&](const Row& fitted_row, double psi) {
      const Row wanted = target.at(psi);
      double worst = reach * (fitted_row - wanted).head<2>().norm() / k_normal_tolerance;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const auto column = 2 + 3 * static_cast<Eigen::Index>(k);
        worst = std::max(worst, (fitted_row - wanted).segment<3>(column).norm() / columns[k].tolerance);
      }
      return worst;
    };
    auto fitted = fit(target, sector.from, sector.to, {});
    if (!fitted)
      throw InputError("", "too large for STEP: its curves take more pieces than a part for CAD may have",
                       "build it without --step: the meshes have it");
    sector.spline = std::move(*fitted);
    sectors_.push_back(std::move(sector));
  }

  /// The strand itself for a ring or a free groove edge, the centre line for a groove.
  Vec3 base_at(const Place& here, double psi) const {
    const Strand& strand = strands_[here.strand];
    if (strand.groove < 0) return ring_at(here.strand, psi);
    const auto g = static_cast<std::size_t>(strand.groove);
    const double turn = psi + k_two_pi * turns_of(here.at);
    return in_groove(g, here.at) ? grooves_[g].at(turn) : free_groove_edge(g, turn, strand.number == 0);
  }

  /// Poles of a piece at the offsets `outward` and `dz` from a groove's centre line.
  std::vector<Vec3> poles_of(const Place& here, double outward, double dz) const {
    const Sector& sector = sectors_[sector_of(here.at)];
    const Strand& strand = strands_[here.strand];
    const bool is_in_groove = strand.groove >= 0 && in_groove(static_cast<std::size_t>(strand.groove), here.at);
    const Place base = is_in_groove ? Place{low_groove_edge(static_cast<std::size_t>(strand.groove)), here.at} : here;
    const Eigen::Index column = sector.columns.at(base);
    std::vector<Vec3> poles;
    for (Eigen::Index i = 0; i < sector.spline.poles.rows(); ++i) {
      Vec3 pole = sector.spline.poles.row(i).segment<3>(column).transpose();
      if (is_in_groove) {
        pole.head<2>() += outward * sector.spline.poles.row(i).head<2>().transpose();
        pole.z() += dz;
      } else if (strand.groove < 0) {
        pole.z() = rings_[strand.number].z;
      }
      poles.push_back(rounded_to_grain(Vec3(layout_.scale * pole)));
    }
    return poles;
  }
  std::vector<Vec3> poles_of(const Place& here) const {
    const Strand& strand = strands_[here.strand];
    if (strand.groove < 0) return poles_of(here, 0, 0);
    const SectionCorner& corner = corners_[strand.number];
    return poles_of(here, corner.outward, corner.dz);
  }

  // ---- cells ----

  bool is_cut(const Cell& cell, std::size_t mark_number) const {
    const double direction = marks_[mark_number];
    for (const Place& side : {cell.low, cell.high}) {
      const Strand& strand = strands_[side.strand];
      const auto g = strand.groove >= 0 ? static_cast<std::size_t>(strand.groove) : rings_[strand.number].groove;
      for (const double cut : extents_[g].cuts) {
        if (std::abs(cut - direction) < k_same_mark) return true;
      }
      if (is_bent_after(side)) return true;
    }
    return false;
  }

  /// True if a strand's speed changes at the next place, so that the two pieces are no smooth curve over ψ.
  bool is_bent_after(const Place& here) const {
    const std::vector<Vec3> before = poles_of(here), after = poles_of(next(here));
    const std::vector<double>& knots = sectors_[sector_of(here.at)].spline.knots;
    const std::vector<double>& later = sectors_[sector_of(here.at + 1)].spline.knots;
    const double step = knots.back() - knots[knots.size() - k_step_degree - 2];
    const double next_step = later[k_step_degree + 1] - later.front();
    // With equal speeds on both sides, the pole at the join divides its neighbours' distance like the knot spans.
    const Vec3 smooth = (next_step * before[before.size() - 2] + step * after[1]) / (step + next_step);
    return (smooth - before.back()).norm() > k_bent;
  }

  void find_cells() {
    for (std::size_t s = 0; s < marks_.size(); ++s) {
      const std::vector<Place> stack = stack_in(s);
      for (std::size_t k = 0; k + 1 < stack.size(); ++k) {
        by_sides_[{stack[k], stack[k + 1]}] = cells_.size();
        cells_.push_back({s, stack[k], stack[k + 1]});
      }
      stacks_.push_back(stack);
    }
    for (Cell& cell : cells_) {
      const auto after = by_sides_.find({next(cell.low), next(cell.high)});
      if (after == by_sides_.end() || is_cut(cell, sector_of(static_cast<int>(cell.sector) + 1))) continue;
      cell.ends_after = false;
      cells_[after->second].ends_before = false;
    }
  }

  /// Places on the side of a cell, upwards, including those of all adjacent cells.
  std::vector<Place> side_of(const Cell& cell, bool after) const {
    const Place low = after ? next(cell.low) : cell.low, high = after ? next(cell.high) : cell.high;
    const Strand &below = strands_[cell.low.strand], &above = strands_[cell.high.strand];
    if (below.groove >= 0 && below.groove == above.groove && cell.low.at == cell.high.at) return {low, high};
    std::vector<Place> there = stacks_[sector_of(static_cast<int>(cell.sector) + (after ? 1 : -1))];
    if (!after) {
      for (Place& here : there) here = next(here);
    }
    const auto from = std::find(there.begin(), there.end(), low), to = std::find(there.begin(), there.end(), high);
    if (from == there.end() || to == there.end()) return {low, high};
    return {from, to + 1};
  }

  void find_corners() {
    for (const Cell& cell : cells_) {
      for (const bool after : {false, true}) {
        if (!(after ? cell.ends_after : cell.ends_before)) continue;
        for (const Place& here : side_of(cell, after)) corner_of_.emplace(here, 0);
      }
    }
    for (auto& [here, corner] : corner_of_) {
      corner = skin_.corners.size();
      skin_.corners.push_back(position_of(here));
    }
    // Fit and rounding have moved the ends of groove edges slightly off the straight between their neighbours.
    for (std::size_t g = 0; g < 2; ++g) {
      for (const bool back : {false, true}) put_groove_edges_on_straight(g, back);
    }
  }

  Vec3 position_of(const Place& here) const {
    if (is_ring(here.strand) || here.at < strands_[here.strand].last) return poles_of(here).front();
    return poles_of({here.strand, here.at - 1}).back();
  }

  void put_groove_edges_on_straight(std::size_t g, bool back) {
    const int end = back ? extents_[g].groove_edges_to : extents_[g].groove_edges_from;
    const Place below = back ? place(extents_[g].ring_below, end) : Place{high_groove_edge(g), end + count()};
    const Place above = back ? Place{low_groove_edge(g), end - count()} : place(extents_[g].ring_above, end);
    const Vec3 from = skin_.corners[corner_of_.at(below)], to = skin_.corners[corner_of_.at(above)];
    for (const bool low : {true, false}) {
      const double share = height_share(g, low, back);
      const Place groove_edge{low ? low_groove_edge(g) : high_groove_edge(g), end};
      skin_.corners[corner_of_.at(groove_edge)] = (1.0 - share) * from + share * to;
    }
  }

  // ---- edges ----

  /// A strand's pieces from one place to another as one curve. Their tangents are equal at the joins, so the pole there
  /// lies between its neighbours and is removed.
  StepSkin::Curve joined_curve(const Place& from, int pieces, double outward, double dz, bool is_edge) const {
    StepSkin::Curve curve;
    double shift = 0;
    for (int k = 0; k < pieces; ++k) {
      const Place here = place(from.strand, from.at + k);
      const Sector& sector = sectors_[sector_of(here.at)];
      std::vector<Vec3> poles = poles_of(here, outward, dz);
      std::vector<double> knots = sector.spline.knots;
      if (k > 0 && sector_of(here.at) == 0) shift += k_two_pi;
      for (double& knot : knots) knot += shift;
      if (k == 0) {
        curve.knots = std::move(knots);
        curve.poles = std::move(poles);
        continue;
      }
      // Two poles, one from each side, remain at the join: multiplicity degree − 1.
      curve.poles.pop_back();
      curve.knots.resize(curve.knots.size() - 2);
      curve.poles.insert(curve.poles.end(), poles.begin() + 1, poles.end());
      curve.knots.insert(curve.knots.end(), knots.begin() + k_step_degree + 1, knots.end());
    }
    if (is_edge) {
      set_end(curve.poles.front(), from);
      set_end(curve.poles.back(), place(from.strand, from.at + pieces));
    }
    return curve;
  }
  StepSkin::Curve joined_curve(const Place& from, int pieces) const {
    const Strand& strand = strands_[from.strand];
    if (strand.groove < 0) return joined_curve(from, pieces, 0, 0, true);
    const SectionCorner& corner = corners_[strand.number];
    return joined_curve(from, pieces, corner.outward, corner.dz, true);
  }
  void set_end(Vec3& pole, const Place& here) const {
    const auto corner = corner_of_.find(here);
    if (corner != corner_of_.end()) pole = skin_.corners[corner->second];
  }

  struct Run {
    Place first;
    int pieces = 0;
  };

  /// Edges along a run of a strand, between corners. On the face they begin at the parameter `param` and have the
  /// parameter `v`: 0 on the lower side, 1 on the upper one.
  std::vector<StepSkin::Use> edges_along(const Run& run, double param, double v) {
    std::vector<StepSkin::Use> uses;
    double at = param;
    for (int done = 0; done < run.pieces;) {
      const Place from = place(run.first.strand, run.first.at + done);
      int pieces = 0;
      double width = 0;
      do {
        const Sector& sector = sectors_[sector_of(from.at + pieces)];
        width += sector.to - sector.from;
        ++pieces;
      } while (done + pieces < run.pieces && corner_of_.count(place(from.strand, from.at + pieces)) == 0);
      auto [known, is_new] = edge_from_.emplace(from, skin_.edges.size());
      if (is_new) {
        const Place to = place(from.strand, from.at + pieces);
        skin_.edges.push_back({corner_of_.at(from), corner_of_.at(to), joined_curve(from, pieces)});
      }
      uses.push_back({known->second, false, Vec2(at, v), Vec2(at + width, v)});
      at += width;
      done += pieces;
    }
    return uses;
  }

  StepSkin::Use straight(std::size_t from, std::size_t to) {
    const auto [known, is_new] =
        straights_.emplace(std::pair(std::min(from, to), std::max(from, to)), skin_.edges.size());
    if (is_new) skin_.edges.push_back({std::min(from, to), std::max(from, to), StepSkin::Straight{}});
    return {known->second, from > to, {}, {}};
  }

  /// The arc from a place of a section's corner to the next corner's.
  StepSkin::Use arc(const Place& low, const Place& high) {
    const std::size_t from = corner_of_.at(low), to = corner_of_.at(high);
    const auto [known, is_new] = arcs_.emplace(std::pair(from, to), skin_.edges.size());
    if (is_new) {
      const SectionCorner& corner = corners_[strands_[low.strand].number];
      const auto g = static_cast<std::size_t>(strands_[low.strand].groove);
      const bool begins = in_groove(g, low.at);
      const std::vector<Vec3> tips =
          poles_of({low.strand, begins ? low.at : low.at - 1}, corner.arc_outward, corner.arc_dz);
      skin_.edges.push_back({from, to, StepSkin::Arc{begins ? tips.front() : tips.back(), corner.weight}});
    }
    return {known->second, false, {}, {}};
  }

  /// Edges up the side of a cell at parameter u.
  std::vector<StepSkin::Use> edges_up(const Cell& cell, bool after, double u) {
    const std::vector<Place> places = side_of(cell, after);
    if (is_arc(cell)) {
      StepSkin::Use use = arc(places.front(), places.back());
      use.from = Vec2(u, 0);
      use.to = Vec2(u, 1);
      return {use};
    }
    const Vec3 foot = skin_.corners[corner_of_.at(places.front())];
    const double height = (skin_.corners[corner_of_.at(places.back())] - foot).norm();
    std::vector<StepSkin::Use> uses;
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      const std::size_t from = corner_of_.at(places[k]), to = corner_of_.at(places[k + 1]);
      StepSkin::Use use = straight(from, to);
      const Vec2 low(u, (skin_.corners[from] - foot).norm() / height),
          high(u, (skin_.corners[to] - foot).norm() / height);
      use.from = use.backwards ? high : low;
      use.to = use.backwards ? low : high;
      uses.push_back(use);
    }
    return uses;
  }

  bool is_arc(const Cell& cell) const {
    const Strand& low = strands_[cell.low.strand];
    return low.groove >= 0 && cell.high.strand == cell.low.strand + 1 && cell.low.at == cell.high.at &&
           in_groove(static_cast<std::size_t>(low.groove), cell.low.at) && corners_[low.number].arc;
  }

  static void append(std::vector<StepSkin::Use>& loop, std::vector<StepSkin::Use> uses, bool backwards) {
    if (backwards) {
      std::reverse(uses.begin(), uses.end());
      for (StepSkin::Use& use : uses) use.backwards = !use.backwards;
    }
    loop.insert(loop.end(), uses.begin(), uses.end());
  }

  // ---- faces ----

  void add_faces() {
    for (const Cell& first : cells_) {
      if (!first.ends_before) continue;
      int pieces = 1;
      const Cell* last = &first;
      while (!last->ends_after) {
        last = &cells_[by_sides_.at({next(last->low), next(last->high)})];
        ++pieces;
      }
      add_face(first, *last, pieces);
    }
  }

  void add_face(const Cell& first, const Cell& last, int pieces) {
    StepSkin::Patch patch;
    const auto add_row = [&](StepSkin::Curve curve) {
      patch.knots = std::move(curve.knots);
      patch.rows.push_back(std::move(curve.poles));
    };
    add_row(joined_curve(first.low, pieces));
    if (is_arc(first)) {
      const SectionCorner& corner = corners_[strands_[first.low.strand].number];
      add_row(joined_curve(first.low, pieces, corner.arc_outward, corner.arc_dz, false));
      patch.weight = corner.weight;
    }
    add_row(joined_curve(first.high, pieces));
    const double from = patch.knots.front(), to = patch.knots.back();
    std::vector<StepSkin::Use> loop;
    append(loop, edges_along({first.low, pieces}, from, 0), false);
    append(loop, edges_up(last, true, to), false);
    append(loop, edges_along({first.high, pieces}, from, 1), true);
    append(loop, edges_up(first, false, from), true);
    skin_.faces.push_back({std::move(patch), {std::move(loop)}});
  }

  /// The end of a groove's section; `along`: +1 if the face looks along the curve, −1 if against it.
  void add_end_wall(std::size_t g, int at, double along) {
    std::vector<StepSkin::Use> loop;
    for (std::size_t k = 0; k + 1 < corners_.size(); ++k) {
      const Place low{extents_[g].strand + k, at}, high{extents_[g].strand + k + 1, at};
      loop.push_back(corners_[k].arc ? arc(low, high) : straight(corner_of_.at(low), corner_of_.at(high)));
    }
    loop.push_back(straight(corner_of_.at({high_groove_edge(g), at}), corner_of_.at({low_groove_edge(g), at})));
    // Inwards and upwards turn counter-clockwise about the tangent.
    std::vector<StepSkin::Use> turned;
    append(turned, loop, along < 0);
    const Vec2 tangent = turned_left(unit(turn_at(at)));
    skin_.faces.push_back({StepSkin::Plane{skin_.corners[corner_of_.at({low_groove_edge(g), at})],
                                           along * Vec3(tangent.x(), tangent.y(), 0)},
                           {std::move(turned)}});
  }

  std::vector<StepSkin::Use> ring_loop(std::size_t strand) {
    int first = 0;
    while (corner_of_.count(place(strand, first)) == 0) ++first;
    return edges_along({place(strand, first), count()}, 0, 0);
  }

  void add_caps() {
    std::vector<StepSkin::Use> below;
    append(below, ring_loop(0), true);
    skin_.faces.push_back({StepSkin::Plane{Vec3::Zero(), -Vec3::UnitZ()}, {std::move(below)}});
    const double top = rounded_to_grain(layout_.scale * plan_.heights.top);
    std::vector<std::vector<StepSkin::Use>> loops{ring_loop(strands_.size() - 1)};
    if (layout_.hub_radius > 0) {
      const double radius = layout_.scale * layout_.hub_radius,
                   head = rounded_to_grain(layout_.scale * plan_.heights.hub_top);
      const auto foot = circle(radius, top), rim = circle(radius, head);
      std::vector<StepSkin::Use> hole;
      append(hole, foot, true);
      loops.push_back(hole);
      for (std::size_t k = 0; k < foot.size(); ++k) {
        const double from = k_pi * static_cast<double>(k), to = from + k_pi;
        const auto up_at = [&](double angle, std::size_t low, std::size_t high) {
          StepSkin::Use use = straight(low, high);
          use.from = Vec2(angle, top);
          use.to = Vec2(angle, head);
          return use;
        };
        const auto round_at = [&](StepSkin::Use use, double z) {
          use.from = Vec2(from, z);
          use.to = Vec2(to, z);
          return use;
        };
        const StepSkin::Edge low = skin_.edges[foot[k].edge], high = skin_.edges[rim[k].edge];
        std::vector<StepSkin::Use> loop{round_at(foot[k], top), up_at(to, low.last, high.last)};
        append(loop, {round_at(rim[k], head)}, true);
        append(loop, {up_at(from, low.first, high.first)}, true);
        skin_.faces.push_back({StepSkin::Cylinder{radius}, {std::move(loop)}});
      }
      skin_.faces.push_back({StepSkin::Plane{Vec3(0, 0, head), Vec3::UnitZ()}, {rim}});
    }
    skin_.faces.push_back({StepSkin::Plane{Vec3(0, 0, top), Vec3::UnitZ()}, std::move(loops)});
  }

  /// A circle in two halves.
  std::vector<StepSkin::Use> circle(double radius, double z) {
    const std::size_t first = skin_.corners.size();
    skin_.corners.emplace_back(radius, 0, z);
    skin_.corners.emplace_back(-radius, 0, z);
    skin_.edges.push_back({first, first + 1, StepSkin::Round{radius, 0, k_pi}});
    skin_.edges.push_back({first + 1, first, StepSkin::Round{radius, k_pi, k_two_pi}});
    return {{skin_.edges.size() - 2, false, {}, {}}, {skin_.edges.size() - 1, false, {}, {}}};
  }

  const Mechanism& mechanism_;
  const helical_solid::HelicalPlan& plan_;
  const solid::BodyLayout& layout_;
  std::vector<SectionCorner> corners_;
  double groove_edge_;
  std::array<HelicalGroove, 2> grooves_;
  std::array<GrooveExtent, 2> extents_;
  std::vector<double> marks_;
  std::vector<RimRing> rings_;
  std::vector<Strand> strands_;
  std::vector<Sector> sectors_;
  std::vector<std::vector<Place>> stacks_;
  std::vector<Cell> cells_;
  std::map<std::pair<Place, Place>, std::size_t> by_sides_;
  std::map<Place, std::size_t> corner_of_, edge_from_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> straights_, arcs_;
  StepSkin skin_;
};

StepTool run_out_pocket(const helical_solid::GrooveEnd& end, const helical_solid::RunOutSizes& sizes) {
  constexpr double k_outside = 1.0;  // mm, beyond the face, so that no faces coincide
  const auto z = [&](double depth) { return end.face - end.outward * depth; };
  Polygon section{{0, z(-k_outside)}, {sizes.pocket_radius, z(-k_outside)}};
  const std::vector<Vec2> profile = helical_solid::pocket_profile(end, sizes);
  for (const Vec2& corner : profile) section.emplace_back(corner.x(), z(corner.y()));
  section.emplace_back(0, z(profile.back().y()));
  return {{StepTurned{helical_solid::pocket_place(end, sizes), std::move(section), 0, k_two_pi}}};
}

}  // namespace

StepSkin helical_skin(const Product& product) { return SkinBuilder(product).build(); }

std::vector<StepTool> run_out_cuts(const Product& product) {
  const helical_solid::HelicalPlan& plan = *product.helix->pulley.plan;
  std::vector<StepTool> tools;
  for (std::size_t i = 0; i < plan.ends.size(); ++i) {
    StepChannel channel;
    for (const helical_solid::ChannelRing& ring : helical_solid::channel_rings(plan.ends[i], plan.run_outs[i], 0))
      channel.rings.push_back({ring.middle, ring.level, ring.up, ring.radius, ring.gap, ring.ridge});
    tools.push_back({{std::move(channel)}});
    tools.push_back(run_out_pocket(plan.ends[i], plan.run_outs[i]));
  }
  return tools;
}

}  // namespace fusee::formats
