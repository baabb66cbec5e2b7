#include "helical_solid/run_out.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fusee/base.h"
#include "solid/boolean.h"
#include "solid/nearest_float.h"
#include "solid/tools.h"

namespace fusee::helical_solid {
namespace {

// Least width of an automatic channel, mm. Narrower ones close in printing, as on one-turn pulleys.
constexpr double k_least_channel = 0.6;
// The channel begins k_before_end before the groove's end, so that the end wall is removed completely. Its peaked
// ceiling rises above the groove's upper wall and leaves a tooth there, which ends k_past_end beyond the end wall. mm
constexpr double k_before_end = 0.02;
constexpr double k_past_end = 0.06;
// Number of facets of a channel and of a pocket in the first variant, and number of chords of the arc.
constexpr int k_channel_facets = 14;
constexpr int k_pocket_facets = 28;
constexpr int k_arc_steps = 9;
// Least length of a straight channel after the arc, in channel radii. A shorter one is omitted.
constexpr double k_shortest_straight = 0.05;
// Least radius of the arc, in tendon diameters.
constexpr double k_sharpest_bend = 2.0;
// Least radius of the arc, in channel radii. Seen from above, the flanks of the peaked ceiling must not meet on the
// inside of the bend. They would at 2.46, where a rising channel has turned by 78°.
constexpr double k_sharpest_channel_bend = 2.8;
// Number of radii of the arc that are tried, from the gentlest to the sharpest bend.
constexpr int k_bends = 5;
// Least slope of a channel's ceiling. Channels dive at 45°, and the ridge of a ceiling of that slope would lie in the
// plane of the next section.
constexpr double k_flattest_peak = radians(57.5);
// Radius of the tip of a pocket's cone, in channel radii.
constexpr double k_tip = 0.2;
// Step by which a pocket is moved inwards until it fits, mm.
constexpr double k_step_inward = 0.05;

// A regular polygon about `centre` in the plane of two unit vectors. `start`: position of its first corner, in facets.
std::vector<Vec3> ring_of(const Vec3& centre, const Vec3& across, const Vec3& up, double radius, int facets,
                          double start) {
  std::vector<Vec3> ring;
  for (int k = 0; k < facets; ++k) {
    const double angle = k_two_pi * (k + start) / facets;
    ring.push_back(centre + radius * (elementary::cos(angle) * across + elementary::sin(angle) * up));
  }
  return ring;
}

// Directions of an arc at its two ends: the tendon's at the groove's end, then inwards and to the face at 45°.
struct Directions {
  Vec3 along, towards;
};

Directions directions_of(const GrooveEnd& end) {
  const Vec2 tangent = end.along * turned_left(end.row.normal);
  const Vec3 along(tangent.x(), tangent.y(), 0.0);
  const Vec3 towards = Vec3(-end.row.normal.x(), -end.row.normal.y(), end.outward).normalized();
  return {along, towards};
}

Vec3 start_of(const GrooveEnd& end) { return {end.row.position.x(), end.row.position.y(), end.row.height}; }

Vec3 arc_point(const GrooveEnd& end, double radius, double turn) {
  const auto [along, towards] = directions_of(end);
  return start_of(end) + radius * (elementary::sin(turn) * along + (1.0 - elementary::cos(turn)) * towards);
}

double arc_turn(int step) { return 0.5 * k_pi * step / k_arc_steps; }
Vec3 arc_place(const GrooveEnd& end, const RunOutSizes& sizes, int step) {
  return arc_point(end, sizes.bend_radius, arc_turn(step));
}

// The innermost point of the channel, in the middle of the pocket.
Vec3 channel_end(const GrooveEnd& end, const RunOutSizes& sizes) {
  const double straight = std::sqrt(2.0) * sizes.inward - sizes.bend_radius;
  return arc_point(end, sizes.bend_radius, 0.5 * k_pi) + straight * directions_of(end).towards;
}

// A channel's section at `middle` across the direction `ahead`. The peaked ceiling leaves the circle where the circle
// is as steep as the cone.
ChannelRing ring_across(const Vec3& middle, const Vec3& ahead, double radius, double ceiling_slope) {
  const Vec3 level = ahead.cross(Vec3::UnitZ()).normalized(), up = level.cross(ahead);
  return {middle,
          level,
          up,
          radius,
          elementary::acos(elementary::cos(ceiling_slope) / up.z()),
          middle + radius / elementary::cos(ceiling_slope) * Vec3::UnitZ()};
}

// Shrinks a ring nearly to the point `to`.
ChannelRing narrowed(const ChannelRing& ring, const Vec3& to) {
  constexpr double k_scale = 0.05;
  const auto scaled = [&](const Vec3& point) -> Vec3 { return to + k_scale * (point - to); };
  return {scaled(ring.middle), ring.level, ring.up, k_scale * ring.radius, ring.gap, scaled(ring.ridge)};
}

// Points of a channel's section in space, with `facets` chords of its circle.
std::vector<Vec3> points_of(const ChannelRing& ring, int facets) {
  std::vector<Vec3> points;
  for (int k = 0; k <= facets; ++k) {
    const Vec2 at = unit(0.5 * k_pi + ring.gap + (k_two_pi - 2.0 * ring.gap) * k / facets);
    points.push_back(ring.middle + ring.radius * (at.x() * ring.level + at.y() * ring.up));
  }
  points.push_back(ring.ridge);
  return points;
}

solid::TriangleMesh channel_of(const GrooveEnd& end, const RunOutSizes& sizes, int variant) {
  std::vector<std::vector<Vec3>> sections;
  for (const ChannelRing& ring : channel_rings(end, sizes, variant))
    sections.push_back(points_of(ring, k_channel_facets + variant));
  return solid::strip(sections);
}

// Depth of the pocket's cylindrical part. It grows with the thickness of the flange.
double pocket_depth(const GrooveEnd& end, const RunOutSizes& sizes) {
  return std::abs(end.face - end.row.height) - sizes.cone - sizes.inward;
}

solid::TriangleMesh pocket_of(const GrooveEnd& end, const RunOutSizes& sizes, int variant) {
  const Vec2 place = pocket_place(end, sizes);
  const auto ring_at = [&](double radius, double in) {
    return ring_of({place.x(), place.y(), end.face - end.outward * in}, Vec3::UnitX(), Vec3::UnitY(), radius,
                   k_pocket_facets + variant, 0.23);
  };
  std::vector<std::vector<Vec3>> sections{ring_at(sizes.pocket_radius, -solid::k_overshoot)};
  for (const Vec2& corner : pocket_profile(end, sizes)) sections.push_back(ring_at(corner.x(), corner.y()));
  return solid::strip(sections);
}

// Sets the channel's entry, slightly inside the groove's section. The channel then cuts the groove's end wall only, and
// none of its faces coincides with the groove's. In a round seat the entry is centred on the tendon. In others it lies
// further out, where their walls leave clearance.
void set_entry(RunOutSizes& sizes, const Body& body, double d) {
  constexpr double k_inside = 0.03, k_further_out = 0.15, k_least = 0.5;  // in tendon diameters
  double radius = body.seat_ratio;  // in tendon diameters, of the groove about the entry's centre
  if (body.groove != Groove::u) {
    sizes.entry_outward = k_further_out * d;
    radius = k_least + k_further_out * elementary::sin(0.5 * body.groove_angle);
  }
  sizes.entry_radius = std::min(std::max(radius - k_inside, k_least) * d, sizes.channel_radius);
}

}  // namespace

RunOutSizes run_out_sizes(const Mechanism& mechanism, const solid::BodyLayout& layout, double share) {
  const double d = mechanism.tendon.diameter;
  RunOutSizes sizes;
  sizes.channel_radius =
      0.5 * (mechanism.body.anchor_hole > 0 ? mechanism.body.anchor_hole : std::max(d + 0.3, k_least_channel));
  set_entry(sizes, mechanism.body, d);
  sizes.pocket_radius = mechanism.body.knot_pocket > 0 ? 0.5 * mechanism.body.knot_pocket
                                                       : share * std::max(1.75 * d, 2.0 * sizes.channel_radius);
  sizes.pocket_depth = sizes.pocket_radius;
  sizes.ceiling_slope = std::max(solid::ridge_slope(layout), k_flattest_peak);
  sizes.cone = solid::rise_of(layout, sizes.pocket_radius - sizes.channel_radius);
  sizes.tip = solid::rise_of(layout, (1.0 - k_tip) * std::min(sizes.pocket_radius, sizes.channel_radius));
  // Way inwards at which the pocket leaves a wall to a straight rim.
  const double to_rim = sizes.pocket_radius + layout.min_wall - (layout.groove_depth - 0.5 * d);
  sizes.sharpest_bend = std::max(k_sharpest_bend * d, k_sharpest_channel_bend * sizes.channel_radius);
  sizes.inward = std::max(to_rim, sizes.sharpest_bend / std::sqrt(2.0));
  sizes.bend_radius = std::sqrt(2.0) * sizes.inward;
  return sizes;
}

std::vector<Vec2> pocket_profile(const GrooveEnd& end, const RunOutSizes& sizes) {
  const double depth = pocket_depth(end, sizes), neck = std::min(sizes.pocket_radius, sizes.channel_radius);
  std::vector<Vec2> profile{{sizes.pocket_radius, depth}};
  // A pocket no wider than its channel has no cone.
  if (sizes.cone > solid::k_float_grain) profile.emplace_back(neck, depth + sizes.cone);
  if (end.outward < 0 && sizes.tip > 0) profile.emplace_back(k_tip * neck, depth + sizes.cone + sizes.tip);
  return profile;
}

Vec2 pocket_place(const GrooveEnd& end, const RunOutSizes& sizes) { return channel_end(end, sizes).head<2>(); }

double rim_wall(const Polygon& rim, const GrooveEnd& end, const RunOutSizes& sizes) {
  return distance_to_edges(rim, pocket_place(end, sizes)) - sizes.pocket_radius;
}

double entry_cover(const Polygon& rim, const GrooveEnd& end, const RunOutSizes& sizes) {
  return distance_to_edges(rim, end.row.position) - sizes.entry_outward - sizes.entry_radius;
}

std::vector<double> channel_radii(const Polygon& rim, const GrooveEnd& end, const RunOutSizes& sizes,
                                  const ChannelRoom& room) {
  // Extent of the channel towards the neighbouring turn, in radii. Only at the lower face that is upwards, up to the
  // ridge of the peaked ceiling.
  const double extent = end.outward < 0 ? 1.0 / elementary::cos(sizes.ceiling_slope) : 1.0;
  std::vector<double> radii;
  for (int k = 1; k <= k_arc_steps; ++k) {
    const Vec3 place = arc_place(end, sizes, k);
    const double to_rim = distance_to_edges(rim, place.head<2>());
    const double to_neighbour = room.neighbour + std::abs(place.z() - end.row.height) - room.cover;
    double radius = std::min(to_rim - room.cover, sizes.channel_radius);
    if (to_rim - radius < room.reach + room.cover) radius = std::min(radius, to_neighbour / extent);
    radii.push_back(std::clamp(radius, radii.empty() ? sizes.entry_radius : radii.back(), sizes.channel_radius));
  }
  return radii;
}

RunOutSizes fitted_into(const Polygon& rim, const GrooveEnd& end, RunOutSizes sizes, double wall) {
  // A gentler arc would cross the rim, which curves inwards.
  const double gentlest = std::clamp(end.row.rho / std::sqrt(2.0), sizes.sharpest_bend, sizes.bend_radius);
  sizes.bend_radius = gentlest;
  const double furthest = end.row.position.dot(end.row.normal);  // to the axis, along the normal
  RunOutSizes best = sizes;
  double thickest = -std::numeric_limits<double>::infinity();
  for (; sizes.inward < furthest; sizes.inward += k_step_inward) {
    for (int k = 0; k < k_bends; ++k) {
      sizes.bend_radius = gentlest + (sizes.sharpest_bend - gentlest) * k / (k_bends - 1);
      const double thickness = rim_wall(rim, end, sizes);
      if (thickness >= wall) return sizes;
      if (thickness <= thickest) continue;
      thickest = thickness;
      best = sizes;
    }
  }
  return best;
}

HelicalAnchor anchor_at(const GrooveEnd& end, const RunOutSizes& sizes) {
  const Vec2 place = pocket_place(end, sizes);
  HelicalAnchor anchor;
  anchor.side = end.side;
  anchor.exit = start_of(end);
  anchor.pocket = {place.x(), place.y(), end.face};
  anchor.pocket_radius = sizes.pocket_radius;
  anchor.pocket_depth = pocket_depth(end, sizes);
  anchor.bend_radius = sizes.bend_radius;
  return anchor;
}

std::vector<ChannelRing> channel_rings(const GrooveEnd& end, const RunOutSizes& sizes, int variant) {
  const auto [along, towards] = directions_of(end);
  std::vector<ChannelRing> rings;
  const auto add = [&](const Vec3& middle, const Vec3& ahead, double radius) {
    rings.push_back(ring_across(middle, ahead, radius, sizes.ceiling_slope));
  };
  // The groove's end wall stands between the first two sections, in the plane of neither.
  const Vec3 entry = start_of(end) + sizes.entry_outward * Vec3(end.row.normal.x(), end.row.normal.y(), 0.0);
  for (const double place : {-k_before_end - 0.003 * variant, k_past_end + 0.005 * variant})
    add(entry + place * along, along, sizes.entry_radius);
  for (int k = 1; k <= k_arc_steps; ++k) {
    const double turn = arc_turn(k);
    add(arc_place(end, sizes, k), elementary::cos(turn) * along + elementary::sin(turn) * towards,
        sizes.channel_radii[static_cast<std::size_t>(k - 1)]);
  }
  // A straight channel continues into the pocket. Below the upper face it rises and ends in a point where ball and cone
  // meet in front. A flat end would have a ceiling as shallow as the channel. Above the lower face a flat end has none.
  const Vec3 last = channel_end(end, sizes);
  if (end.outward < 0) {
    constexpr double k_past_middle = 0.8;  // of the pocket, in channel radii
    add(last + k_past_middle * sizes.channel_radius * towards, towards, sizes.channel_radius);
    return rings;
  }
  if ((last - rings.back().middle).norm() > k_shortest_straight * sizes.channel_radius)
    add(last, towards, sizes.channel_radius);
  const Vec3 inwards(-end.row.normal.x(), -end.row.normal.y(), 0.0);
  const Vec3 front =
      elementary::sin(sizes.ceiling_slope) * inwards + elementary::cos(sizes.ceiling_slope) * Vec3::UnitZ();
  rings.push_back(narrowed(rings.back(), last + sizes.channel_radius * front));
  return rings;
}

std::optional<solid::TriangleMesh> run_out_tool(const GrooveEnd& end, const RunOutSizes& sizes, int variant) {
  const auto both = solid::unite(solid::rounded_to_float(channel_of(end, sizes, variant)),
                                 solid::rounded_to_float(pocket_of(end, sizes, variant)));
  if (!both) return std::nullopt;
  return both->mesh;
}

}  // namespace fusee::helical_solid
