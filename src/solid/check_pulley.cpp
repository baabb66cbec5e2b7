#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/solid.h"
#include "solid/euler.h"
#include "solid/nearest_float.h"
#include "solid/nearest_segment.h"
#include "solid/plane_distance.h"

namespace fusee::solid {
namespace {

// Relative tolerance of the volume: much smaller than any feature, much larger than the rounding of vertices.
constexpr double k_volume_tolerance = 1e-6;
// Distance kept from cut features while measuring the groove, mm. A tool's facets lie closer than this to the plan's
// outline.
constexpr double k_beside = 0.1;

std::string place_in_plan(const Vec2& point) { return "(" + fixed(point.x(), 3) + ", " + fixed(point.y(), 3) + ") mm"; }

// Measures one groove on sections of a mesh, in the pulley's own mm (without the mesh's scale).
class GrooveGauge {
 public:
  GrooveGauge(const TriangleMesh& mesh, const Mechanism& mechanism, const profile::Outline& outline,
              const Pulley& pulley)
      : mesh_(mesh),
        d_(mechanism.tendon.diameter),
        outline_(outline),
        pulley_(pulley),
        layout_(pulley.layout),
        left_(outline.side == transmission::Side::left) {
    floor_ = profile::parallel(outline, -0.5 * d_);
    for (Polygon& loop : loops_at(z())) (signed_area(loop) > 0 ? outlines_ : holes_).push_back(std::move(loop));
  }

  void add_checks(std::vector<Check>& checks, double chord_error_mm, double min_wall) const {
    const std::string suffix = left_ ? "_P1" : "_P2";
    if (outlines_.empty()) {
      checks.push_back({"floor_deviation" + suffix, 0, chord_error_mm, "mm", false,
                        fmt::format("no closed section at z = {} mm", rounded(z()))});
      return;
    }
    const auto [deviation, where] = floor_deviation();
    checks.push_back(at_most("floor_deviation" + suffix, deviation, chord_error_mm + k_float_grain, "mm",
                             "P" + std::string(left_ ? "1" : "2") + " at " + place_in_plan(where)));
    checks.push_back(at_least("wall" + suffix, thinnest_wall(), min_wall - k_float_grain, "mm",
                              fmt::format("in the section at z = {} mm", rounded(z()))));
    checks.push_back(at_least("groove_depth" + suffix, depth(), layout_.groove_depth - chord_error_mm, "mm",
                              "between floor and flange"));
    checks.push_back(at_least("groove_width" + suffix, width(), d_ - k_float_grain, "mm",
                              "at the height of the tendon's centre line"));
  }

 private:
  double z() const { return left_ ? layout_.z_p1 : layout_.z_p2; }

  std::vector<Polygon> loops_at(double height) const {
    std::vector<Polygon> loops = section(mesh_, height * layout_.scale);
    for (Polygon& loop : loops) {
      for (Vec2& point : loop) point /= layout_.scale;
    }
    return loops;
  }

  // A channel entry has no floor to measure.
  bool is_at_entry(const Vec2& point, double margin = k_beside) const {
    return std::any_of(pulley_.anchors.begin(), pulley_.anchors.end(), [&](const Anchor& anchor) {
      return anchor.side == outline_.side &&
             (is_within(anchor.channel, point, margin) || is_within(anchor.entry, point, margin));
    });
  }

  // True within a feature of this groove: the channel with its entry, the knot's pocket, the tail's slot with its
  // screw.
  bool in_a_feature(const Vec2& point) const {
    const auto within = [&point](const Vec2& centre, double radius) {
      return (point - centre).norm() < radius + k_beside;
    };
    return is_at_entry(point) || std::any_of(pulley_.anchors.begin(), pulley_.anchors.end(), [&](const Anchor& anchor) {
             if (anchor.side != outline_.side) return false;
             if (within(anchor.pocket, pocket_radius(anchor, layout_))) return true;
             return anchor.tail && (is_within(anchor.tail->outline(), point, k_beside) ||
                                    within(anchor.tail->to, 0.5 * anchor.tail->pilot_diameter));
           });
  }

  // The parts of a loop outside tie-off features, as lines.
  std::vector<Polygon> beside_features(const Polygon& loop) const {
    std::vector<Polygon> lines;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if (!in_a_feature(a) || !in_a_feature(b)) lines.push_back({a, b});
    }
    return lines;
  }

  // True within `margin` of a closed outline, or inside it.
  static bool is_within(const Polygon& outline, const Vec2& point, double margin) {
    return !outline.empty() && (is_inside(outline, point) || distance_to_edges(outline, point) < margin);
  }

  struct Deviation {
    double value = 0;
    Vec2 where = Vec2::Zero();
    void consider(double deviation, const Vec2& point) {
      // NaN counts as a deviation too.
      if (!(deviation <= value)) *this = {deviation, point};
    }
  };

  // Distance between the section and the polygon of the analytic curve, both ways, plus the sagitta of that polygon's
  // chords.
  Deviation floor_deviation() const {
    Deviation worst;
    const NearestSegment to_floor({floor_}), to_section(outlines_);
    for (const Polygon& outline : outlines_) {
      for (const Vec2& point : outline) {
        if (!is_at_entry(point)) worst.consider(to_floor.distance(point), point);
      }
    }
    for (std::size_t i = 0; i < floor_.size(); ++i) {
      if (outline_.is_active(i) || !is_at_entry(floor_[i])) worst.consider(to_section.distance(floor_[i]), floor_[i]);
    }
    worst.value += largest_sagitta();
    return worst;
  }

  double largest_sagitta() const {
    double largest = 0;
    const auto& points = outline_.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t j = (i + 1) % points.size();
      largest = std::max(largest, profile::sagitta(floor_[i], points[i].psi, floor_[j], points[j].psi));
    }
    return largest;
  }

  // The holes of the section are the bore and its screws. The outline includes the tie-offs.
  double thinnest_wall() const {
    if (holes_.empty()) return 0;
    double least = std::numeric_limits<double>::infinity();
    const NearestSegment to_outline(outlines_), to_holes(holes_);
    for (const Polygon& hole : holes_) {
      for (const Vec2& point : hole) least = std::min(least, to_outline.distance(point));
    }
    for (const Polygon& outline : outlines_) {
      for (const Vec2& point : outline) least = std::min(least, to_holes.distance(point));
    }
    return least;
  }

  double depth() const {
    // Slightly beyond the groove edge, in the flange that belongs to P1 or P2 only.
    const double past = 0.5 * std::min(0.2, layout_.flange_thickness);
    const std::vector<Polygon> flange =
        loops_at(left_ ? z() - layout_.p1.below_width() - past : z() + layout_.p2.above_width() + past);
    if (flange.empty()) return 0;
    const NearestSegment to_flange(beside_features(outer_loop(flange)));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < floor_.size(); ++i) {
      if (outline_.is_active(i) && !is_at_entry(floor_[i], layout_.groove_depth))
        least = std::min(least, to_flange.distance(floor_[i]));
    }
    return least;
  }

  // Width along a vertical line through the middle of one chord of the pitch curve: from the facet below the groove's
  // plane to the one above. The line's height on a facet follows from the barycentric weights of its point in plan.
  double width() const {
    const std::size_t n = outline_.points.size(), i = (outline_.active_first + 1) % n;
    const Vec2 point = layout_.scale * 0.5 * (outline_.points[i].position + outline_.points[(i + 1) % n].position);
    double below = -std::numeric_limits<double>::infinity(), above = -below;
    for (const auto& triangle : mesh_.triangles) {
      const Vec3 &a = mesh_.vertices[triangle[0]], &b = mesh_.vertices[triangle[1]], &c = mesh_.vertices[triangle[2]];
      const Vec2 to_a = a.head<2>() - point, to_b = b.head<2>() - point, to_c = c.head<2>() - point;
      const double weight_a = cross(to_b, to_c), weight_b = cross(to_c, to_a), weight_c = cross(to_a, to_b);
      const bool covers =
          (weight_a > 0 && weight_b > 0 && weight_c > 0) || (weight_a < 0 && weight_b < 0 && weight_c < 0);
      if (!covers) continue;
      const double height =
          (weight_a * a.z() + weight_b * b.z() + weight_c * c.z()) / (weight_a + weight_b + weight_c) / layout_.scale;
      if (height < z()) {
        below = std::max(below, height);
      } else {
        above = std::min(above, height);
      }
    }
    return std::isfinite(above - below) ? above - below : 0.0;
  }

  const TriangleMesh& mesh_;
  double d_;  ///< diameter of the tendon
  const profile::Outline& outline_;
  const Pulley& pulley_;
  const BodyLayout& layout_;
  bool left_;
  Polygon floor_;
  std::vector<Polygon> outlines_;
  std::vector<Polygon> holes_;
};

// True if the first three checks of check_mesh() hold: there are facets, their indices exist, their vertices are
// finite.
bool is_measurable(const std::vector<Check>& checks) { return checks[0].ok && checks[1].ok && checks[2].ok; }

// True if all facets, in the same order, are at the same places, for any vertex numbering.
bool is_same(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.triangles.size() != b.triangles.size()) return false;
  for (std::size_t f = 0; f < a.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = a.triangles[f][k], j = b.triangles[f][k];
      if (i >= a.vertices.size() || j >= b.vertices.size() || a.vertices[i] != b.vertices[j]) return false;
    }
  }
  return true;
}

// If the mesh read back equals the mesh that was made, the checks of the latter apply.
std::vector<Check> checks_of(const TriangleMesh& mesh, const TriangleMesh& made, const std::vector<Check>& of_made) {
  return !of_made.empty() && is_same(mesh, made) ? of_made : check_mesh(mesh);
}

std::vector<Check> check_body(const TriangleMesh& mesh, std::vector<Check> checks, int expected_euler,
                              double expected_volume) {
  if (!is_measurable(checks)) return checks;
  checks.push_back(
      exactly("euler_number", euler_number(mesh), expected_euler, "1", "a hole is missing, closed or surplus"));
  const double volume = enclosed_volume(mesh);
  checks.push_back(at_most("volume_deviation", std::abs(volume / expected_volume - 1.0), k_volume_tolerance, "1",
                           fmt::format("{} mm³ instead of {} mm³", rounded(volume, 9), rounded(expected_volume, 9))));
  return checks;
}

}  // namespace

std::vector<Check> check_pulley(const TriangleMesh& mesh, const Mechanism& mechanism,
                                const profile::SynthesisResult& synthesis, const Pulley& pulley,
                                double chord_error_mm) {
  demand(pulley.made(), "check of a pulley that was not made");
  std::vector<Check> checks =
      check_body(mesh, checks_of(mesh, pulley.mesh, pulley.mesh_checks), pulley.expected_euler, pulley.expected_volume);
  if (!is_measurable(checks)) return checks;
  GrooveGauge(mesh, mechanism, synthesis.p1, pulley).add_checks(checks, chord_error_mm, pulley.layout.min_wall);
  GrooveGauge(mesh, mechanism, synthesis.p2, pulley).add_checks(checks, chord_error_mm, pulley.layout.min_wall);
  return checks;
}

std::vector<Check> check_printed_part(const TriangleMesh& mesh, const PrintedPart& part) {
  return check_body(mesh, checks_of(mesh, part.mesh, part.mesh_checks), part.expected_euler, part.expected_volume);
}

}  // namespace fusee::solid
