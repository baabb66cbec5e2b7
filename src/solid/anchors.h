/// \file
/// Where tendons are tied off: a channel that leaves the groove's floor tangentially, turns inward, and ends in a knot
/// pocket. mm, rad.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fusee/profile/outline.h"
#include "solid/plane_distance.h"

namespace fusee {

/// Chords of a channel's arc.
inline constexpr int k_fillet_steps = 6;

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

  Vec2 heading() const;  ///< along the straight
  Vec2 outer() const;    ///< unit vector across the straight, away from the fillet's centre
  Vec2 pocket() const;
  /// The line at `aside` from the centre line, away from the fillet's centre; its arc in `steps` chords. Without the
  /// pocket.
  std::vector<Vec2> edge(double aside, int steps) const;
  std::vector<Bar> bars(double width) const;
};

struct AnchorSite {
  const Outline& outline;
  double tendon_diameter = 0;
  double width = 0;  ///< of the channel
  double fillet = 0;
  double wall = 0;
  std::vector<Bar> holes;         ///< channel and pocket keep `wall` clear of these
  std::vector<Bar> above_pocket;  ///< the pocket alone keeps clear of these: what stands on the face it opens at
};

/// The path with the most room for a pocket of radius `wanted`, the shortest of those with all of it; null when no
/// channel fits at all. `near`: only short channels that do not pass the axis.
enum class AnchorReach { near, anywhere };
std::optional<AnchorPath> find_anchor(const AnchorSite& site, bool wound_end, double wanted, AnchorReach reach);

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
