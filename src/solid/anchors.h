/// \file
/// Where tendons are tied off: a channel that leaves the groove's floor tangentially, turns inward, and ends in a knot
/// pocket. mm, rad.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "fusee/profile/outline.h"
#include "solid/plane_distance.h"

namespace fusee {

/// Chords of a channel's arc.
inline constexpr int k_fillet_steps = 6;
/// A pocket's closed end is this much deeper than its channel, and the tab in which the channel ends this much wider
/// and longer, so that no two of their faces coincide.
inline constexpr double k_deeper = 0.07;
/// Half the width of that tab.
double half_tab(double width, double radius);
/// A place of the closing arc.
struct Station {
  double lap = 0;   ///< along the pitch curve from the end of the active arc
  double wrap = 0;  ///< by how much the pitch curve turns over that
  Vec2 position;
  Vec2 normal;
};

/// Walks an outline's closing arc from one end of the active arc to the other. Refers to the outline.
class ArcWalk {
 public:
  ArcWalk(const Outline& outline, bool wound_end);

  /// +1: counter-clockwise.
  double sense() const { return sense_; }
  double length() const { return reach_.back(); }
  /// The active arc is the whole turn: there is nothing to walk.
  bool is_empty() const { return index_.size() < 2; }
  /// There or just past it, between two points. Not of an empty one.
  Station at(double lap) const;
  /// Infinite where the arc turns by less.
  double lap_at(double wrap) const;

 private:
  struct Place {
    std::size_t above;
    double share;
  };
  static Place place(const std::vector<double>& increasing, double value);

  const Outline& outline_;
  double sense_ = 1;
  std::vector<double> reach_;
  std::vector<double> wrap_;
  std::vector<std::size_t> index_;
};

/// The channel's centre line: from `start` on the pitch curve along the tangent, an arc that turns inward by `turn`, a
/// straight to the pocket.
struct AnchorPath {
  Vec2 start;
  Vec2 normal;       ///< outward, at the start
  double sense = 1;  ///< +1: the channel runs counter-clockwise from its mouth, −1: clockwise
  double fillet = 0;
  double turn = 0;  ///< > 0
  double straight = 0;
  double room = 0;  ///< radius of the largest pocket, up to the one wanted
  double lap = 0;   ///< along the pitch curve from the end of the active arc to `start`
  double wrap = 0;  ///< by how much the pitch curve turns over that

  Vec2 heading() const;  ///< along the straight
  Vec2 outer() const;    ///< unit vector across the straight, away from the fillet's centre
  Vec2 pocket() const;
  /// The line at `aside` from the centre line, away from the fillet's centre; its arc in `steps` chords. Without the
  /// pocket.
  std::vector<Vec2> edge(double aside, int steps) const;
  std::vector<Bar> bars(double width) const;
  /// Both sides of the tab behind a pocket of this radius: a little further out than the channel's.
  std::array<Bar, 2> tab_sides(double width, double radius) const;
};

/// Where on the closing arc a channel may begin, along the pitch curve from the end of the active arc. mm
struct LapRange {
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
};
/// What tie-offs on one outline are looked for by: made once, asked hundreds of times. Refers to the outline.
class AnchorGround {
 public:
  AnchorGround(const Outline& outline, double tendon_diameter);

  const Outline& outline() const { return outline_; }
  const ArcWalk& arc(bool wound_end) const { return wound_end ? from_wound_end_ : from_spare_end_; }
  /// All that leaves at least this much wrap past the active arc, rad. Empty (least > most) where the closing arc ends
  /// before.
  LapRange lap_range(bool wound_end, double least_wrap) const;
  /// Below the groove's floor, negative outside.
  double depth_of(const Vec2& point) const;
  /// The floor's part that a tendon lies on.
  const std::vector<Vec2>& active_floor() const { return active_floor_; }
  /// Of the floor's furthest point.
  double radius() const { return radius_; }

 private:
  const Outline& outline_;
  ArcWalk from_wound_end_, from_spare_end_;
  std::vector<Vec2> active_floor_;
  // Half-planes that the floor lies in: x·inward ≥ offset.
  Eigen::ArrayXd inward_x_, inward_y_, offset_;
  double radius_ = 0;
};

struct AnchorSite {
  const AnchorGround& ground;
  double tendon_diameter = 0;
  double width = 0;  ///< of the channel
  double fillet = 0;
  double wall = 0;
  std::vector<Bar> holes;         ///< channel and pocket keep `wall` clear of these
  std::vector<Bar> above_pocket;  ///< the pocket alone keeps clear of these: what stands on the face it opens at
  const Polygon* rim = nullptr;   ///< of the outer flange
};

/// Where a channel and its pocket have no room: a slot through the outer flange, round at the groove's floor and open
/// to the rim. The knot lies in a countersink of the face. A hole that is closed towards the rim would have the
/// groove's roof grow over it in print, from nothing.
struct FaceHole {
  Vec2 start;  ///< on the pitch curve beside the slot
  Vec2 normal;
  Vec2 hole;               ///< middle of the slot's round end
  double hole_radius = 0;  ///< half the slot's width
  double room = 0;         ///< radius of the countersink at the face
  double lap = 0;
  double wrap = 0;
  double length = 0;  ///< from `hole` outwards to where it has left the flange

  /// Middle of the countersink: its circle and that of the slot's end touch on the outer side, where the flange ends.
  Vec2 pocket() const { return hole - (room - hole_radius) * normal; }
  Vec2 open_end() const { return hole + length * normal; }
  std::vector<Bar> bars(double) const { return {{hole, open_end(), hole_radius}}; }
};

/// At most this many points of a floor, evenly spread, and those of `always`: no more are needed to keep a wall to it.
/// Indices, increasing.
std::vector<std::size_t> coarse_floor(std::size_t points, const std::vector<std::size_t>& always = {});

/// The path with the most room for a pocket of radius `wanted`, the shortest of those with all of it; null when no
/// channel fits at all. `near`: only short channels that do not pass the axis.
enum class AnchorReach { near, anywhere };
std::optional<AnchorPath> find_anchor(const AnchorSite& site, bool wound_end, double wanted, AnchorReach reach,
                                      const LapRange& laps = {});

/// The keyhole in the groove's plane: channel and pocket of `radius`, counter-clockwise. `facets` on the pocket.
struct Keyhole {
  std::vector<Vec2> points;            ///< all corners
  std::vector<std::uint32_t> outline;  ///< channel and pocket
  std::vector<std::uint32_t> pocket;   ///< the whole pocket
  std::vector<std::uint32_t> channel;  ///< what the channel adds to it
};
Keyhole keyhole(const AnchorPath& path, double width, double radius, int facets);
/// Facets of a pocket for a knot.
int pocket_facets(double radius);
Polygon outline_of(const Keyhole& keyhole);

}  // namespace fusee
