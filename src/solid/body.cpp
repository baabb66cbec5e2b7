#include "solid/body.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "solid/bore.h"
#include "solid/plane_distance.h"

namespace fusee::solid {
namespace {

// Distance of a rim from the outlines it must contain: larger than any facet's sagitta, too small to notice. mm
constexpr double k_rim_margin = 0.2;
// Largest sagitta of the hub's facets, mm.
constexpr double k_hub_sagitta = 0.01;
// Width τ of the transition of the middle flange from one groove edge to the other, mm.
constexpr double k_blend = 0.5;

// A circle sampled at the outline's normals.
Polygon circle_like(const profile::Outline& outline, double radius) {
  Polygon points;
  points.reserve(outline.points.size());
  for (const profile::OutlinePoint& point : outline.points) points.push_back(radius * point.normal);
  return points;
}

// The hub's circle, with enough points for its sagitta. The fraction in the angle keeps its corners off the axes.
Polygon circle(double radius) {
  const int sides = std::max(24, static_cast<int>(std::ceil(k_pi / elementary::acos(1.0 - k_hub_sagitta / radius))));
  Polygon points;
  for (int k = 0; k < sides; ++k) points.push_back(radius * unit(k_two_pi * (k + 0.37) / sides));
  return points;
}

// True if no quad of the flat band between two outlines of equal normals is folded.
bool strictly_outside(const Polygon& outer, const Polygon& inner) {
  const std::size_t n = inner.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const Vec2 along_inner = inner[j] - inner[i], along_outer = outer[j] - outer[i];
    const bool clear = cross(along_inner, outer[i] - inner[i]) < 0 && cross(along_inner, outer[j] - inner[i]) < 0 &&
                       cross(along_outer, inner[i] - outer[i]) > 0 && cross(along_outer, inner[j] - outer[i]) > 0;
    if (!clear) return false;
  }
  return true;
}

// Outline around both curves: the smooth maximum of their support functions, h = τ log(e^{h1/τ} + e^{h2/τ}). With the
// weights wi = e^{hi/τ}/(e^{h1/τ} + e^{h2/τ}), its radius of curvature h + h'' is the weighted mean of both radii plus
// w1 w2 (h1' − h2')²/τ > 0, so it is convex. Its point is h n + h' t with h' = w1 h1' + w2 h2'.
Polygon around_both(const profile::Outline& p1, const profile::Outline& p2, double offset, double margin) {
  Polygon points;
  points.reserve(p1.points.size());
  for (std::size_t i = 0; i < p1.points.size(); ++i) {
    const Vec2& normal = p1.points[i].normal;
    const Vec2 tangent = turned_left(normal);
    const double h1 = p1.points[i].position.dot(normal), h2 = p2.points[i].position.dot(normal);
    const double larger = std::max(h1, h2);
    const double e1 = elementary::exp((h1 - larger) / k_blend), e2 = elementary::exp((h2 - larger) / k_blend);
    const double h = larger + k_blend * elementary::log(e1 + e2) + offset + margin;
    const double dh = (e1 * p1.points[i].position.dot(tangent) + e2 * p2.points[i].position.dot(tangent)) / (e1 + e2);
    points.push_back(h * normal + dh * tangent);
  }
  return points;
}

// Widens a rim until it lies strictly outside `a` and `b`. Coarse outlines require larger margins. Sets `outside` to
// false if no margin suffices.
template <typename MakeRim>
Polygon grown_until_outside(const MakeRim& make_rim, const Polygon& a, const Polygon& b, bool& outside) {
  double margin = k_rim_margin;
  Polygon rim = make_rim(margin);
  for (int tries = 0; tries < 12 && !(strictly_outside(rim, a) && strictly_outside(rim, b)); ++tries) {
    margin *= 1.5;
    rim = make_rim(margin);
  }
  outside = outside && strictly_outside(rim, a) && strictly_outside(rim, b);
  return rim;
}

class StackBuilder {
 public:
  StackBuilder(const profile::Outline& p1, const profile::Outline& p2, double tendon_diameter, Flange kind,
               const BodyLayout& layout)
      : p1_(p1),
        p2_(p2),
        d_(tendon_diameter),
        layout_(layout),
        kind_(kind),
        rims_(flange_rims(p1, p2, tendon_diameter, layout.groove_depth, kind)) {}

  RingStack build(Piece piece) {
    if (piece != Piece::p2) add_p1();
    if (piece != Piece::p1) add_p2();
    const double low = piece == Piece::p2 ? layout_.z_mate : 0.0;
    const double high = piece == Piece::p1 ? layout_.z_mate : layout_.z_hub;
    if (piece != Piece::p1 && layout_.hub_radius > 0) {
      stack_.hub = Shaft{circle(layout_.hub_radius), layout_.z_top, layout_.z_hub};
    }
    add_bore(low, high);
    return std::move(stack_);
  }

 private:
  bool apart() const { return layout_.parts == Parts::two; }

  // Skips a ring that equals the previous one.
  void add(double z, Polygon points) {
    if (!stack_.rings.empty() && stack_.rings.back().z == z && stack_.rings.back().points == points) return;
    stack_.rings.push_back({z, std::move(points)});
  }

  // Adds all rings of P1: up to the bottom of the middle flange if the pulley is one part, otherwise up to the face
  // that meets P2.
  void add_p1() {
    if (apart()) {
      add(0.0, rims_.lower);
    } else {
      add_foot(0.0, rims_.lower);
    }
    const double groove_edge_low = layout_.z_p1 - layout_.p1.below_width(),
                 groove_edge_high = layout_.z_p1 + layout_.p1.above_width();
    if (kind_ == Flange::round) add(groove_edge_low - layout_.lower_cone, rims_.lower);
    add_groove(p1_, layout_.z_p1, layout_.p1);
    add(groove_edge_high + layout_.middle_cone, rims_.middle);
    if (!apart()) return;
    add(layout_.z_mate - rise_of(layout_, layout_.elephant_foot), rims_.middle);
    add(layout_.z_mate, foot_of(rims_.middle));
  }

  void add_p2() {
    const double groove_edge_low = layout_.z_p2 - layout_.p2.below_width(),
                 groove_edge_high = layout_.z_p2 + layout_.p2.above_width();
    if (apart()) {
      add_foot(layout_.z_mate, rims_.under2);
      if (kind_ == Flange::round) add(groove_edge_low, rims_.under2);
    } else {
      add(groove_edge_low, rims_.middle);
    }
    add_groove(p2_, layout_.z_p2, layout_.p2);
    if (kind_ == Flange::round) add(groove_edge_high + layout_.upper_cone, rims_.upper);
    add(layout_.z_top, rims_.upper);
  }

  // Chamfers the edge on the bed, because a first layer spreads beyond its outline.
  void add_foot(double bed, const Polygon& rim) {
    add(bed, foot_of(rim));
    add(bed + rise_of(layout_, layout_.elephant_foot), rim);
  }

  // Moves every point inward along the normal that all rings share.
  Polygon foot_of(Polygon rim) const {
    for (std::size_t i = 0; i < rim.size(); ++i) rim[i] -= layout_.elephant_foot * p1_.points[i].normal;
    return rim;
  }

  void add_groove(const profile::Outline& outline, double z, const GrooveWalls& walls) {
    const auto add_point = [&](const GroovePoint& point, double sign) {
      add(z + sign * point.dz, profile::parallel(outline, -0.5 * d_ + point.offset));
    };
    for (std::size_t k = walls.below.size(); k-- > 1;) add_point(walls.below[k], -1.0);
    for (std::size_t k = 1; k < walls.above.size(); ++k) add_point(walls.above[k], 1.0);
  }

  // A horn's recess opens at the bottom face. Above it, only the screw holes continue.
  void add_bore(double low, double high) {
    const BoreLayout& bore = layout_.bore;
    const bool has_recess = low == 0.0 && bore.horn_recess > 0;
    if (has_recess) {
      stack_.recess = recess(high);
    } else if (bore.horn_recess <= 0) {
      stack_.through.push_back({bore.outline, low, high});
    }
    // The rings of a recess with a cone include the centre screw's hole, which is the first one.
    const bool includes_centre_hole = has_recess && stack_.recess.back().z == high;
    for (std::size_t k = includes_centre_hole ? 1 : 0; k < bore.screw_holes.size(); ++k) {
      const double bottom = has_recess && k == 0 ? stack_.recess.back().z : low;
      stack_.through.push_back({bore.screw_holes[k], bottom, high});
    }
  }

  // A flat ceiling would be a ring about the centre screw's hole, which no printer bridges. A cone leads up into the
  // hole instead.
  std::vector<Ring> recess(double top) const {
    const BoreLayout& bore = layout_.bore;
    if (bore.horn_ceiling <= 0) return {{0.0, bore.outline}, {bore.horn_recess, bore.outline}};
    const RecessCone cone = recess_cone(bore);
    return {{0.0, cone.rim},
            {bore.horn_recess, cone.rim},
            {bore.horn_recess + bore.horn_ceiling, cone.hole},
            {top, cone.hole}};
  }

  const profile::Outline& p1_;
  const profile::Outline& p2_;
  double d_;  ///< diameter of the tendon
  const BodyLayout& layout_;
  Flange kind_;
  FlangeRims rims_;
  RingStack stack_;
};

// Distance of a point from the line through an edge.
double gap_to_line(const Vec2& point, const Vec2& a, const Vec2& b) {
  return std::abs(cross(b - a, point - a)) / (b - a).norm();
}

}  // namespace

FlangeRims flange_rims(const profile::Outline& p1, const profile::Outline& p2, double tendon_diameter,
                       double groove_depth, Flange kind) {
  demand(p1.points.size() == p2.points.size() && p1.points.size() >= 3,
         "outlines of " + std::to_string(p1.points.size()) + " and " + std::to_string(p2.points.size()) + " points");
  const double groove_edge = groove_depth - 0.5 * tendon_diameter;
  FlangeRims rims;
  rims.groove_edge1 = profile::parallel(p1, groove_edge);
  rims.groove_edge2 = profile::parallel(p2, groove_edge);
  if (kind == Flange::follow) {
    rims.lower = rims.groove_edge1;
    rims.upper = rims.groove_edge2;
    rims.under2 = rims.groove_edge2;
    rims.middle = grown_until_outside([&](double margin) { return around_both(p1, p2, groove_edge, margin); },
                                      rims.groove_edge1, rims.groove_edge2, rims.outside);
    return rims;
  }
  const auto circle_around = [&p1, &rims](const Polygon& a, const Polygon& b) {
    const double radius = std::max(circumradius(a), circumradius(b));
    return grown_until_outside([&](double margin) { return circle_like(p1, radius + margin); }, a, b, rims.outside);
  };
  rims.lower = circle_around(rims.groove_edge1, rims.groove_edge1);
  rims.upper = circle_around(rims.groove_edge2, rims.groove_edge2);
  rims.under2 = rims.upper;
  rims.middle = circle_around(rims.groove_edge1, rims.under2);
  return rims;
}

double cone_height(const Polygon& inner, const Polygon& outer, double slope) {
  const std::size_t n = inner.size();
  double widest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    // A strip's quad may be split along either diagonal.
    for (const Vec2& corner : {outer[i], outer[j]}) widest = std::max(widest, gap_to_line(corner, inner[i], inner[j]));
    for (const Vec2& corner : {inner[i], inner[j]}) widest = std::max(widest, gap_to_line(corner, outer[i], outer[j]));
  }
  return widest * elementary::tan(slope);
}

RingStack body_stack(const profile::Outline& p1, const profile::Outline& p2, double tendon_diameter, Flange kind,
                     const BodyLayout& layout, Piece piece) {
  return StackBuilder(p1, p2, tendon_diameter, kind, layout).build(piece);
}

double inradius(const Polygon& convex) { return depth_inside(convex, Vec2::Zero()); }

}  // namespace fusee::solid
