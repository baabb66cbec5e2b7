#include "solid/body.h"

#include <algorithm>
#include <cmath>

#include "fusee/base/diagnostics.h"
#include "fusee/base/units.h"
#include "solid/bore.h"
#include "solid/plane_distance.h"

namespace fusee {
namespace {

// How far a rim stands outside what it must contain: more than any facet's sagitta, less than anyone would see.
constexpr double k_rim_margin = 0.2;
constexpr double k_hub_sagitta = 0.01;
// Width of the blend where the middle flange changes from following one lip to following the other.
constexpr double k_blend = 0.5;

// The circle at the same normals.
Polygon circle_like(const Outline& outline, double radius) {
  Polygon points;
  points.reserve(outline.points.size());
  for (const OutlinePoint& point : outline.points) points.push_back(radius * point.normal);
  return points;
}

// The hub's own circle, as fine as it needs to be.
Polygon circle(double radius) {
  const int sides = std::max(24, static_cast<int>(std::ceil(k_pi / std::acos(1.0 - k_hub_sagitta / radius))));
  Polygon points;
  for (int k = 0; k < sides; ++k) points.push_back(radius * unit(k_two_pi * (k + 0.37) / sides));
  return points;
}

// Is each flat quad between two loops of equal normals free of folds?
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

// Round both outlines by the smooth maximum of their support functions, h = τ log(e^{h1/τ} + e^{h2/τ}). Its radius of
// curvature h + h'' is the weighted mean of both plus w1 w2 (h1' − h2')²/τ > 0, so it is convex; its point is h n + h'
// t with h' = w1 h1' + w2 h2'.
Polygon around_both(const Outline& p1, const Outline& p2, double offset, double margin) {
  Polygon points;
  points.reserve(p1.points.size());
  for (std::size_t i = 0; i < p1.points.size(); ++i) {
    const Vec2& normal = p1.points[i].normal;
    const Vec2 tangent = turned_left(normal);
    const double h1 = p1.points[i].position.dot(normal), h2 = p2.points[i].position.dot(normal);
    const double larger = std::max(h1, h2);
    const double e1 = std::exp((h1 - larger) / k_blend), e2 = std::exp((h2 - larger) / k_blend);
    const double h = larger + k_blend * std::log(e1 + e2) + offset + margin;
    const double dh = (e1 * p1.points[i].position.dot(tangent) + e2 * p2.points[i].position.dot(tangent)) / (e1 + e2);
    points.push_back(h * normal + dh * tangent);
  }
  return points;
}

// The first rim of growing margin that is strictly outside: coarse outlines need more than fine ones. `outside` becomes
// false where none is.
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
  StackBuilder(const Outline& p1, const Outline& p2, double tendon_diameter, Flange kind, const BodyLayout& layout)
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

  // A ring that is already there is not added again.
  void add(double z, Polygon points) {
    if (!stack_.rings.empty() && stack_.rings.back().z == z && stack_.rings.back().points == points) return;
    stack_.rings.push_back({z, std::move(points)});
  }

  // Up to the middle flange: its bottom where the part is one, the face that P2 lies on where it is two.
  void add_p1() {
    if (apart()) {
      add(0.0, rims_.lower);
    } else {
      add_foot(0.0, rims_.lower);
    }
    const double lip_low = layout_.z_p1 - layout_.p1.below_width(), lip_high = layout_.z_p1 + layout_.p1.above_width();
    if (kind_ == Flange::round) add(lip_low - layout_.lower_cone, rims_.lower);
    add_groove(p1_, layout_.z_p1, layout_.p1);
    add(lip_high + layout_.middle_cone, rims_.middle);
    if (!apart()) return;
    add(layout_.z_mate - rise_of(layout_, layout_.elephant_foot), rims_.middle);
    add(layout_.z_mate, foot_of(rims_.middle));
  }

  void add_p2() {
    const double lip_low = layout_.z_p2 - layout_.p2.below_width(), lip_high = layout_.z_p2 + layout_.p2.above_width();
    if (apart()) {
      add_foot(layout_.z_mate, rims_.under2);
      if (kind_ == Flange::round) add(lip_low, rims_.under2);
    } else {
      add(lip_low, rims_.middle);
    }
    add_groove(p2_, layout_.z_p2, layout_.p2);
    if (kind_ == Flange::round) add(lip_high + layout_.upper_cone, rims_.upper);
    add(layout_.z_top, rims_.upper);
  }

  // The edge on the bed is chamfered by the width to which a first layer spreads.
  void add_foot(double bed, const Polygon& rim) {
    add(bed, foot_of(rim));
    add(bed + rise_of(layout_, layout_.elephant_foot), rim);
  }

  // Every point moved inward along the normal that all rings share.
  Polygon foot_of(Polygon rim) const {
    for (std::size_t i = 0; i < rim.size(); ++i) rim[i] -= layout_.elephant_foot * p1_.points[i].normal;
    return rim;
  }

  void add_groove(const Outline& outline, double z, const GrooveWalls& walls) {
    const auto add_point = [&](const GroovePoint& point, double sign) {
      add(z + sign * point.dz, parallel(outline, -0.5 * d_ + point.offset));
    };
    for (std::size_t k = walls.below.size(); k-- > 1;) add_point(walls.below[k], -1.0);
    for (std::size_t k = 1; k < walls.above.size(); ++k) add_point(walls.above[k], 1.0);
  }

  void add_bore(double low, double high) {
    const BoreLayout& bore = layout_.bore;
    const bool recessed = low == 0.0 && bore.horn_recess > 0;
    if (recessed) {
      stack_.recess = recess(high);
    } else if (bore.horn_recess <= 0) {
      stack_.through.push_back({bore.outline, low, high});
    }
    const bool holed = recessed && stack_.recess.back().z == high;
    for (std::size_t k = holed ? 1 : 0; k < bore.screw_holes.size(); ++k)
      stack_.through.push_back({bore.screw_holes[k], recessed && k == 0 ? stack_.recess.back().z : low, high});
  }

  // Its ceiling would be a ring about the centre screw's hole, which no printer bridges: a cone leads up into the hole.
  std::vector<Ring> recess(double top) const {
    const BoreLayout& bore = layout_.bore;
    if (bore.horn_roof <= 0) return {{0.0, bore.outline}, {bore.horn_recess, bore.outline}};
    const RecessCone cone = recess_cone(bore);
    return {{0.0, cone.rim},
            {bore.horn_recess, cone.rim},
            {bore.horn_recess + bore.horn_roof, cone.hole},
            {top, cone.hole}};
  }

  const Outline& p1_;
  const Outline& p2_;
  double d_;
  const BodyLayout& layout_;
  Flange kind_;
  FlangeRims rims_;
  RingStack stack_;
};

// Of a point from the line through an edge.
double gap_to_line(const Vec2& point, const Vec2& a, const Vec2& b) {
  return std::abs(cross(b - a, point - a)) / (b - a).norm();
}

}  // namespace

FlangeRims flange_rims(const Outline& p1, const Outline& p2, double tendon_diameter, double groove_depth, Flange kind) {
  demand(p1.points.size() == p2.points.size() && p1.points.size() >= 3,
         "outlines of " + std::to_string(p1.points.size()) + " and " + std::to_string(p2.points.size()) + " points");
  const double lip = groove_depth - 0.5 * tendon_diameter;
  FlangeRims rims;
  rims.lip1 = parallel(p1, lip);
  rims.lip2 = parallel(p2, lip);
  if (kind == Flange::follow) {
    rims.lower = rims.lip1;
    rims.upper = rims.lip2;
    rims.under2 = rims.lip2;
    rims.middle = grown_until_outside([&](double margin) { return around_both(p1, p2, lip, margin); }, rims.lip1,
                                      rims.lip2, rims.outside);
    return rims;
  }
  const auto circle_around = [&p1, &rims](const Polygon& a, const Polygon& b) {
    const double radius = std::max(circumradius(a), circumradius(b));
    return grown_until_outside([&](double margin) { return circle_like(p1, radius + margin); }, a, b, rims.outside);
  };
  rims.lower = circle_around(rims.lip1, rims.lip1);
  rims.upper = circle_around(rims.lip2, rims.lip2);
  rims.under2 = rims.upper;
  rims.middle = circle_around(rims.lip1, rims.under2);
  return rims;
}

double cone_height(const Polygon& inner, const Polygon& outer, double slope) {
  const std::size_t n = inner.size();
  double widest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    // A strip's quad may be cut along either diagonal.
    for (const Vec2& corner : {outer[i], outer[j]}) widest = std::max(widest, gap_to_line(corner, inner[i], inner[j]));
    for (const Vec2& corner : {inner[i], inner[j]}) widest = std::max(widest, gap_to_line(corner, outer[i], outer[j]));
  }
  return widest * std::tan(slope);
}

RingStack body_stack(const Outline& p1, const Outline& p2, double tendon_diameter, Flange kind,
                     const BodyLayout& layout, Piece piece) {
  return StackBuilder(p1, p2, tendon_diameter, kind, layout).build(piece);
}

double inradius(const Polygon& convex) { return depth_inside(convex, Vec2::Zero()); }

}  // namespace fusee
