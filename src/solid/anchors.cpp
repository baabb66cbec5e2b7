#include "solid/anchors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fusee/base.h"

namespace fusee::solid {
namespace {

// Distances from the end of the active arc (or of the requested wrap) at which a channel entry may begin, in tendon
// diameters.
constexpr std::array<double, 5> k_laps{1.6, 2.5, 4.0, 6.0, 9.0};
// Least unit of these distances, in channel widths. It replaces the diameter of a tendon that is thinner.
constexpr double k_least_lap_unit = 0.6;
// Longest straight of a near tie-off, in fillet radii.
constexpr double k_near_fillets = 6.0;
// Least distance between a channel's start and a point of the outline, relative to a chord. The body's edges run along
// the points' normals. If such an edge lay in the wall of the entry, rounding to floats would open a gap in the cut.
constexpr double k_from_point = 0.15;
// Clearance between a channel and the floor that a tendon lies on, mm.
constexpr double k_floor_gap = 0.05;
// Relative margin for rounding when straights without enough space are skipped.
constexpr double k_skip_margin = 1e-6;
// Largest number of straights tried. Without this limit, a rejection took half a minute on a pulley of 2 m with a thin
// tendon.
constexpr double k_most_straights = 400;
// Least radius of a knot's pocket, in channel widths.
constexpr double k_least_room = 0.55;
// Shortest straight tried, in channel widths: slightly more than the least room, because the straight limits the room.
constexpr double k_shortest_straight = 0.6;
// Approximate number of floor points to which walls are measured. The chords of a circle of 50 mm lie within 4 µm of
// it.
constexpr std::size_t k_floor_points = 256;

class AnchorSearch {
 public:
  AnchorSearch(const AnchorSite& site, bool wound_end, double wanted, AnchorReach reach, const LapRange& laps)
      : site_(site), ground_(site.ground), arc_(ground_.arc(wound_end)), wanted_(wanted), reach_(reach), laps_(laps) {}

  // Tries starts near the end of the active arc first, then preferred turns, then short straights. Stops at the first
  // path with the requested pocket.
  std::optional<AnchorPath> run() {
    if (wanted_ < k_least_room * site_.width) return std::nullopt;
    // In degrees, the preferred turn first.
    constexpr std::array<double, 6> turns{70, 85, 55, 100, 115, 40};
    const double lap_unit = std::max(site_.tendon_diameter, k_least_lap_unit * site_.width);
    const double first = std::max(k_laps.front() * lap_unit, laps_.least), last = std::min(arc_.length(), laps_.most);
    for (const double lap : k_laps) {
      const Station station = arc_.at(first + (lap - k_laps.front()) * lap_unit);
      if (station.lap > last) break;
      for (const double turn : turns) {
        if (try_straights(station, radians(turn))) return best_;
      }
    }
    return best_;
  }

 private:
  // Returns true if a path with the requested pocket was found. A longer straight meets all obstacles of a shorter one.
  bool try_straights(const Station& station, double turn) {
    const double longest = reach_ == AnchorReach::near ? k_near_fillets * site_.fillet : 2.0 * ground_.radius();
    const double step = std::max(0.5 * site_.width, longest / k_most_straights);
    AnchorPath path{station.position, station.normal, arc_.sense(), site_.fillet, turn, 0, 0,
                    station.lap,      station.wrap};
    const Vec2 outer = path.outer(), heading = path.heading();
    double shortest = 0;  // all shorter straights have too little room
    for (double straight = k_shortest_straight * site_.width; straight < longest; straight += step) {
      if (straight < shortest) continue;
      const Vec2 pocket = path.start - path.fillet * path.normal + path.fillet * outer + straight * heading;
      const double depth = ground_.depth_of(pocket);
      if (depth < -site_.width) break;
      if (reach_ == AnchorReach::near && heading.dot(pocket) > 0) break;
      path.straight = straight;
      path.room = room_at(pocket, depth, straight);
      const double least = best_ ? std::max(best_->room, k_least_room * site_.width) : k_least_room * site_.width;
      if (!(path.room >= k_least_room * site_.width) || (best_ && path.room <= best_->room)) {
        // The room grows at most as fast as the straight. No straight that is skipped would have ended the loop: the
        // floor is convex, so the depth has no dip in between.
        shortest = straight + (1.0 - k_skip_margin) * (least - path.room);
        continue;
      }
      if (!channel_fits(path)) break;
      best_ = path;
      if (path.room >= wanted_) return true;
    }
    return false;
  }

  // Radius of the largest pocket at this place, at most the requested one and at most the straight: the pocket's circle
  // must meet the channel's edges on the straight.
  double room_at(const Vec2& pocket, double depth, double straight) const {
    double room = std::min({wanted_, depth - site_.wall, straight});
    for (const auto* bars : {&site_.holes, &site_.above_pocket}) {
      for (const Bar& bar : *bars) room = std::min(room, gap({pocket, pocket, 0.0}, bar) - site_.wall);
    }
    return room;
  }

  // The floor that the tendon lies on is tested first, and the straight before the rest, because most channels fail
  // there.
  bool channel_fits(const AnchorPath& path) const {
    if (is_at_floor({{path.pocket() - path.straight * path.heading(), path.pocket(), 0.5 * site_.width}})) return false;
    const std::vector<Bar> bars = path.bars(site_.width);
    if (is_at_floor(bars)) return false;
    // The cut bulges out over the chords of the arc and over both sides of the straight at the pocket. In a joint of 24
    // mm this consumed 0.35 µm of a wall of 0.4 mm.
    const double bulge = path.fillet * (1.0 - elementary::cos(0.5 * path.turn / k_fillet_steps));
    const auto keeps = [this](const Bar& bar, double wall) {
      return std::all_of(site_.holes.begin(), site_.holes.end(),
                         [&](const Bar& hole) { return gap(bar, hole) >= wall; });
    };
    for (const Bar& bar : bars) {
      const bool is_straight = &bar == &bars.back();
      if (!keeps(bar, site_.wall + (is_straight ? 0.0 : bulge))) return false;
    }
    for (const Bar& side : path.tab_sides(site_.width, path.room)) {
      if (!keeps(side, site_.wall)) return false;
    }
    return true;
  }

  bool is_at_floor(const std::vector<Bar>& bars) const {
    const double clear = 0.5 * site_.width + k_floor_gap;
    Vec2 low = bars.front().a, high = low;
    for (const Bar& bar : bars) {
      low = low.cwiseMin(bar.b);
      high = high.cwiseMax(bar.b);
    }
    return std::any_of(ground_.active_floor().begin(), ground_.active_floor().end(), [&](const Vec2& point) {
      const bool is_far = ((low - point).array() > clear).any() || ((point - high).array() > clear).any();
      return !is_far && std::any_of(bars.begin(), bars.end(),
                                    [&](const Bar& bar) { return distance_to_segment(point, bar.a, bar.b) < clear; });
    });
  }

  const AnchorSite& site_;
  const AnchorGround& ground_;
  const ArcWalk& arc_;
  double wanted_;
  AnchorReach reach_;
  LapRange laps_;
  std::optional<AnchorPath> best_;
};

}  // namespace

Vec2 AnchorPath::outer() const { return turned(normal, sense * turn); }
Vec2 AnchorPath::heading() const { return sense * turned_left(outer()); }
Vec2 AnchorPath::pocket() const { return start - fillet * normal + fillet * outer() + straight * heading(); }

std::vector<Vec2> AnchorPath::edge(double aside, int steps) const {
  const Vec2 centre = start - fillet * normal;
  std::vector<Vec2> points;
  for (int k = 0; k <= steps; ++k)
    points.push_back(centre + (fillet + aside) * turned(normal, sense * turn * k / steps));
  return points;
}

std::vector<Bar> AnchorPath::bars(double width) const {
  std::vector<Vec2> line = edge(0.0, k_fillet_steps);
  line.push_back(pocket());
  std::vector<Bar> result;
  for (std::size_t k = 1; k < line.size(); ++k) result.push_back({line[k - 1], line[k], 0.5 * width});
  return result;
}

double half_tab(double width, double radius) { return std::min(0.5 * width + 0.5 * k_pocket_excess, 0.95 * radius); }

std::array<Bar, 2> AnchorPath::tab_sides(double width, double radius) const {
  const Vec2 end = pocket() - (radius + k_pocket_excess) * heading(), aside = half_tab(width, radius) * outer();
  return {Bar{pocket() + aside, end + aside, 0.0}, Bar{pocket() - aside, end - aside, 0.0}};
}

ArcWalk::ArcWalk(const profile::Outline& outline, bool wound_end) : outline_(outline) {
  const bool from_last = (outline.side == transmission::Side::left) == wound_end;
  sense_ = from_last ? 1.0 : -1.0;
  const std::size_t from = from_last ? outline.active_last : outline.active_first;
  const std::size_t to = from_last ? outline.active_first : outline.active_last;
  const std::size_t n = outline.points.size();
  laps_.push_back(0.0);
  wraps_.push_back(0.0);
  indices_.push_back(from);
  while (indices_.back() != to) {
    const std::size_t next = from_last ? (indices_.back() + 1) % n : (indices_.back() + n - 1) % n;
    const profile::OutlinePoint &here = outline.points[indices_.back()], &there = outline.points[next];
    laps_.push_back(laps_.back() + (there.position - here.position).norm());
    wraps_.push_back(wraps_.back() + std::abs(std::remainder(there.psi - here.psi, k_two_pi)));
    indices_.push_back(next);
  }
}

Station ArcWalk::at(double requested_lap) const {
  demand(!is_empty(), "a walk along no arc");
  auto [k, share] = interval_of(laps_, requested_lap);
  if (share > 1.0 - k_from_point && k + 1 < indices_.size()) {
    ++k;
    share = 0.0;
  }
  share = std::clamp(share, k_from_point, 1.0 - k_from_point);
  const profile::OutlinePoint &a = outline_.points[indices_[k - 1]], &b = outline_.points[indices_[k]];
  const double lap = laps_[k - 1] + share * (laps_[k] - laps_[k - 1]);
  return {lap, wraps_[k - 1] + share * (wraps_[k] - wraps_[k - 1]), a.position + share * (b.position - a.position),
          (a.normal + share * (b.normal - a.normal)).normalized()};
}

double ArcWalk::lap_at(double wrap) const {
  if (is_empty() || wrap > wraps_.back()) return std::numeric_limits<double>::infinity();
  const auto [k, share] = interval_of(wraps_, wrap);
  return laps_[k - 1] + share * (laps_[k] - laps_[k - 1]);
}

ArcWalk::Interval ArcWalk::interval_of(const std::vector<double>& increasing, double value) {
  const auto end = std::upper_bound(increasing.begin() + 1, increasing.end() - 1, value);
  const auto k = static_cast<std::size_t>(end - increasing.begin());
  return {k, std::clamp((value - increasing[k - 1]) / (increasing[k] - increasing[k - 1]), 0.0, 1.0)};
}

AnchorGround::AnchorGround(const profile::Outline& outline, double tendon_diameter)
    : outline_(outline), from_wound_end_(outline, true), from_spare_end_(outline, false) {
  const Polygon all = profile::parallel(outline, -0.5 * tendon_diameter);
  Polygon floor;
  for (const std::size_t i : coarse_floor(all.size(), {outline.active_first, outline.active_last})) {
    floor.push_back(all[i]);
    if (outline.is_active(i)) active_floor_.push_back(all[i]);
  }
  const auto sides = static_cast<Eigen::Index>(floor.size());
  inward_x_.resize(sides);
  inward_y_.resize(sides);
  offset_.resize(sides);
  for (std::size_t i = 0; i < floor.size(); ++i) {
    const auto side = static_cast<Eigen::Index>(i);
    const Vec2 inward = turned_left(floor[(i + 1) % floor.size()] - floor[i]).normalized();
    inward_x_[side] = inward.x();
    inward_y_[side] = inward.y();
    offset_[side] = inward.dot(floor[i]);
    radius_ = std::max(radius_, floor[i].norm());
  }
}

double AnchorGround::depth_of(const Vec2& point) const {
  return (inward_x_ * point.x() + inward_y_ * point.y() - offset_).minCoeff();
}

LapRange AnchorGround::lap_range(bool wound_end, double least_wrap) const {
  return {arc(wound_end).lap_at(least_wrap), arc(wound_end).length()};
}

std::vector<std::size_t> coarse_floor(std::size_t points, const std::vector<std::size_t>& always) {
  const std::size_t stride = std::max<std::size_t>(1, points / k_floor_points);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < points; ++i) {
    if (i % stride == 0 || std::find(always.begin(), always.end(), i) != always.end()) indices.push_back(i);
  }
  return indices;
}

std::optional<AnchorPath> find_anchor(const AnchorSite& site, bool wound_end, double wanted, AnchorReach reach,
                                      const LapRange& laps) {
  demand(site.fillet > 0.5 * site.width,
         "a channel of " + std::to_string(site.width) + " mm with a fillet of " + std::to_string(site.fillet));
  if (site.ground.arc(wound_end).is_empty()) return std::nullopt;
  return AnchorSearch(site, wound_end, wanted, reach, laps).run();
}

int pocket_facets(double radius) {
  constexpr double k_sagitta = 0.02;  // mm
  constexpr int k_fewest = 12, k_most = 64;
  const double half_angle = elementary::acos(1.0 - std::min(0.5, k_sagitta / radius));  // of a facet
  return std::clamp(static_cast<int>(std::ceil(k_pi / half_angle)), k_fewest, k_most);
}

// Order of the corners: outer edge, pocket from the outer edge round to the inner one, inner edge backwards, and the
// point of the pocket's circle in the middle of its opening to the channel.
Keyhole keyhole(const AnchorPath& path, double width, double radius, int facets) {
  demand(radius > 0.5 * width, "a pocket narrower than its channel");
  const Vec2 centre = path.pocket(), heading = path.heading(), inner = -path.outer();
  const double half_opening = elementary::asin(0.5 * width / radius);  // angle seen from the pocket's centre
  const auto on_pocket = [&](double angle) {
    return Vec2(centre + radius * (elementary::cos(angle) * heading + elementary::sin(angle) * inner));
  };
  std::vector<Vec2> points = path.edge(0.5 * width, k_fillet_steps);
  const auto pocket_first = static_cast<std::uint32_t>(points.size());
  for (int k = 0; k <= facets; ++k) points.push_back(on_pocket((k_pi - half_opening) * (2.0 * k / facets - 1.0)));
  const auto inner_first = static_cast<std::uint32_t>(points.size());
  std::vector<Vec2> back = path.edge(-0.5 * width, k_fillet_steps);
  points.insert(points.end(), back.rbegin(), back.rend());
  const auto opening_first = static_cast<std::uint32_t>(points.size());
  points.push_back(on_pocket(k_pi));

  Keyhole result;
  for (std::uint32_t i = 0; i < opening_first; ++i) result.outline.push_back(i);
  for (std::uint32_t i = pocket_first; i < inner_first; ++i) result.pocket.push_back(i);
  result.pocket.push_back(opening_first);
  for (std::uint32_t i = 0; i <= pocket_first; ++i) result.channel.push_back(i);
  result.channel.push_back(opening_first);
  for (std::uint32_t i = inner_first - 1; i < opening_first; ++i) result.channel.push_back(i);
  result.points = std::move(points);
  if (path.sense < 0) {
    for (auto* loop : {&result.outline, &result.pocket, &result.channel}) std::reverse(loop->begin(), loop->end());
  }
  return result;
}

Polygon outline_of(const Keyhole& keyhole) {
  Polygon outline;
  for (const std::uint32_t index : keyhole.outline) outline.push_back(keyhole.points[index]);
  return outline;
}

}  // namespace fusee::solid
