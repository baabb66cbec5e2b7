/// \file
/// Internal: tie-offs of tendons. A channel leaves the groove's floor tangentially, turns inward, and ends in a knot
/// pocket. mm, rad.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "fusee/profile.h"
#include "solid/plane_distance.h"

namespace fusee::solid {

/// Number of chords of a channel's arc in plans and outlines. The arc is cut with more chords (channel_entries.cpp).
inline constexpr int k_fillet_steps = 6;
/// Excess of a pocket over its channel, mm. The pocket's closed end is deeper than the channel by this. The tab of the
/// pocket, in which the channel ends, is wider and longer than the channel by this. No two of their faces then
/// coincide.
inline constexpr double k_pocket_excess = 0.07;
/// Half the width of the tab between a channel of this width and a pocket of this radius.
double half_tab(double width, double radius);

/// A place on the closing arc.
struct Station {
  double lap = 0;   ///< length along the pitch curve from the end of the active arc
  double wrap = 0;  ///< angle by which the pitch curve turns over that length
  Vec2 position;
  Vec2 normal;
};

/// Walks an outline's closing arc from one end of the active arc to the other. Keeps a reference to the outline.
class ArcWalk {
 public:
  ArcWalk(const profile::Outline& outline, bool wound_end);

  /// +1 if the walk is counter-clockwise, −1 otherwise.
  double sense() const { return sense_; }
  double length() const { return laps_.back(); }
  /// True if the active arc is the whole turn, so that there is no closing arc.
  bool is_empty() const { return indices_.size() < 2; }
  /// The place at `lap` or slightly past it, clear of the outline's points. In the last chord it may lie slightly
  /// before. It is interpolated between two points. Requires a walk that is not empty.
  Station at(double lap) const;
  /// The length along the arc over which the pitch curve turns by `wrap`. Infinite if the whole arc turns by less.
  double lap_at(double wrap) const;

 private:
  /// The interval of a list that contains a value.
  struct Interval {
    std::size_t end;  ///< index of its upper end
    double share;     ///< position of the value within it: 0 at the lower end, 1 at the upper end
  };
  static Interval interval_of(const std::vector<double>& increasing, double value);

  const profile::Outline& outline_;
  double sense_ = 1;
  // For each point of the arc: its lap, its wrap, and its index in the outline.
  std::vector<double> laps_;
  std::vector<double> wraps_;
  std::vector<std::size_t> indices_;
};

/// The channel's centre line: from `start` on the pitch curve along the tangent, then an arc that turns inward by
/// `turn`, then a straight to the pocket.
struct AnchorPath {
  Vec2 start;
  Vec2 normal;          ///< outward, at the start
  double sense = 1;     ///< +1: the channel runs counter-clockwise from its entry, −1: clockwise
  double fillet = 0;    ///< radius of the arc
  double turn = 0;      ///< angle of the arc, > 0
  double straight = 0;  ///< length of the straight
  double room = 0;      ///< radius of the largest pocket, at most the requested one
  double lap = 0;       ///< length along the pitch curve from the end of the active arc to `start`
  double wrap = 0;      ///< angle by which the pitch curve turns over that length

  Vec2 heading() const;  ///< direction of the straight
  Vec2 outer() const;    ///< unit vector across the straight, away from the fillet's centre
  Vec2 pocket() const;   ///< centre of the pocket, the end of the straight
  /// The arc of the line at distance `aside` from the centre line, on the side away from the fillet's centre, as
  /// `steps` chords. Its last point is the beginning of the straight.
  std::vector<Vec2> edge(double aside, int steps) const;
  /// A channel of this width as bars: the arc's chords, then the straight.
  std::vector<Bar> bars(double width) const;
  /// Both sides of the tab behind a pocket of this radius, slightly further out than the channel's sides.
  std::array<Bar, 2> tab_sides(double width, double radius) const;
};

/// Range of starting places of a channel along the pitch curve, from the end of the active arc. mm
struct LapRange {
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
};
/// Data for the search for tie-offs on one outline, computed once and queried hundreds of times. Keeps a reference to
/// the outline.
class AnchorGround {
 public:
  AnchorGround(const profile::Outline& outline, double tendon_diameter);

  const profile::Outline& outline() const { return outline_; }
  const ArcWalk& arc(bool wound_end) const { return wound_end ? from_wound_end_ : from_spare_end_; }
  /// The range that leaves at least this much wrap past the active arc, rad. Empty (least > most) if the closing arc
  /// ends before.
  LapRange lap_range(bool wound_end, double least_wrap) const;
  /// Depth below the groove's floor, negative outside.
  double depth_of(const Vec2& point) const;
  /// The part of the floor that a tendon lies on.
  const std::vector<Vec2>& active_floor() const { return active_floor_; }
  /// Distance of the floor's furthest point from the axis.
  double radius() const { return radius_; }

 private:
  const profile::Outline& outline_;
  ArcWalk from_wound_end_, from_spare_end_;
  std::vector<Vec2> active_floor_;
  // Half-planes whose intersection is the floor: x·inward ≥ offset.
  Eigen::ArrayXd inward_x_, inward_y_, offset_;
  double radius_ = 0;
};

/// Sizes of a tie-off and the obstacles to it, for one search.
struct AnchorSite {
  const AnchorGround& ground;
  double tendon_diameter = 0;
  double width = 0;               ///< width of the channel
  double fillet = 0;              ///< radius of the channel's arc, to its centre line
  double wall = 0;                ///< least thickness of walls
  std::vector<Bar> holes;         ///< channel and pocket keep `wall` clear of these
  std::vector<Bar> above_pocket;  ///< obstacles for the pocket only: features of the face that it opens at
  const Polygon* rim = nullptr;   ///< rim of the outer flange; required for a FaceHole only
};

/// A tie-off for pulleys without space for a channel and its pocket: a slot through the outer flange, round at the
/// groove's floor and open to the rim. The knot lies in a countersink of the face. A hole closed towards the rim would
/// make the groove's ceiling above it begin in mid-air.
struct FaceHole {
  Vec2 start;  ///< on the pitch curve beside the slot
  Vec2 normal;
  Vec2 hole;               ///< centre of the slot's round end
  double hole_radius = 0;  ///< half the slot's width
  double room = 0;         ///< radius of the countersink at the face
  double lap = 0;          ///< length along the pitch curve from the end of the active arc to `start`
  double wrap = 0;         ///< angle by which the pitch curve turns over that length
  double length = 0;       ///< length from `hole` outwards to the rim

  /// Centre of the countersink. Its circle and that of the slot's end touch on the outer side, where the flange ends.
  Vec2 pocket() const { return hole - (room - hole_radius) * normal; }
  Vec2 open_end() const { return hole + length * normal; }
  /// Ignores the channel's width, which AnchorPath::bars() requires.
  std::vector<Bar> bars(double) const { return {{hole, open_end(), hole_radius}}; }
};

/// Indices of about 256 evenly spread points of a floor of `points` points, and those in `always`, in increasing order.
/// These points suffice to keep a wall to the floor.
std::vector<std::size_t> coarse_floor(std::size_t points, const std::vector<std::size_t>& always = {});

/// near: only short channels that do not pass the axis.
enum class AnchorReach { near, anywhere };
/// The path with the largest pocket up to radius `wanted`. Of those that reach it, the first one tried: starts near the
/// end of the active arc come first, then preferred turns, then short straights. Empty when no channel fits.
std::optional<AnchorPath> find_anchor(const AnchorSite& site, bool wound_end, double wanted, AnchorReach reach,
                                      const LapRange& laps = {});

/// A channel and its pocket in the groove's plane: corners, and counter-clockwise loops as indices of corners.
struct Keyhole {
  std::vector<Vec2> points;            ///< all corners
  std::vector<std::uint32_t> outline;  ///< channel and pocket
  std::vector<std::uint32_t> pocket;   ///< the whole pocket
  std::vector<std::uint32_t> channel;  ///< the part of the channel outside the pocket
};
/// `width`: of the channel. `radius`, `facets`: of the pocket.
Keyhole keyhole(const AnchorPath& path, double width, double radius, int facets);
/// Number of facets of a knot pocket.
int pocket_facets(double radius);
Polygon outline_of(const Keyhole& keyhole);

}  // namespace fusee::solid
