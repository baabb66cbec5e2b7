#include "pipeline/axle_clearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/text.h"
#include "export/report/tendon_trace.h"
#include "fusee/mechanism_file.h"

namespace fusee::pipeline {
namespace {

/// Radius of the thinnest axle or post, M3, mm.
constexpr double k_thinnest_radius = 1.5;
/// Required clearance, mm; the same as for a pin.
constexpr double k_clearance = 0.5;

/// A part of the joint and its smallest distance from the flanges.
struct NearestPart {
  std::string part;     ///< "the joint's axle"
  double distance = 0;  ///< from the part's axis to the flanges, mm; negative: inside
  double theta = 0;     ///< joint angle of the smallest distance, rad
};

/// Reach of the pulley from its axis by direction, mm, in the frame of the mesh at home.
class ReachAround {
 public:
  explicit ReachAround(const solid::Pulley& pulley) {
    for (const Vec3& vertex : pulley.mesh.vertices) {
      const Vec2 flat = vertex.head<2>() / pulley.layout.scale;
      double& reach = reach_.at(sector_of(elementary::atan2(flat.y(), flat.x())));
      reach = std::max(reach, flat.norm());
    }
  }

  /// Reach towards a place of the joint, within the angle that the thinnest axle there subtends. The pulley is turned
  /// clockwise by `alpha`.
  double reach_towards(const Vec2& place, double alpha) const {
    const double distance = place.norm(), direction = elementary::atan2(place.y(), place.x()) + alpha;
    const double half_angle = distance > k_thinnest_radius ? elementary::asin(k_thinnest_radius / distance) : k_pi;
    double reach = 0;
    for (double turn = -half_angle; turn <= half_angle; turn += k_sector)
      reach = std::max(reach, reach_.at(sector_of(direction + turn)));
    return reach;
  }

 private:
  // Facets of an outline turn by 2 deg at most: one that spans a sector of 3 deg has a vertex in a neighbouring sector.
  static constexpr std::size_t k_sectors = 120;
  static constexpr double k_sector = k_two_pi / k_sectors;

  static std::size_t sector_of(double angle) {
    const double turns = angle / k_two_pi;
    return static_cast<std::size_t>((turns - std::floor(turns)) * k_sectors) % k_sectors;
  }

  std::array<double, k_sectors> reach_{};
};

std::vector<NearestPart> nearest_parts(const formats::Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const Vec2 axis = formats::pulley_axis(mechanism);
  const ReachAround reach(product.pulley);
  std::vector<NearestPart> parts;
  const auto measure = [&](const std::string& name, const auto& place_at) {
    NearestPart nearest{name, std::numeric_limits<double>::infinity(), 0};
    for (const transmission::TransmissionPoint& point : product.synthesis.stroke) {
      const Vec2 place = place_at(point.theta) - axis;
      const double distance = place.norm() - reach.reach_towards(place, point.alpha);
      if (distance < nearest.distance) nearest = {name, distance, point.theta};
    }
    parts.push_back(nearest);
  };
  measure("the joint's axle", [](double) { return Vec2(Vec2::Zero()); });
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    measure(fmt::format("the end of tendon {} on the link", side == transmission::Side::left ? 1 : 2),
            [&](double theta) { return formats::attachment(mechanism, side, theta); });
  }
  return parts;
}

/// The part with the smallest clearance, if that is less than required.
std::optional<NearestPart> tightest_part(const formats::Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  if (mechanism.sheath.is_there() || mechanism.joint.drum_radius > 0 || product.pulley.mesh.vertices.empty())
    return std::nullopt;
  const std::vector<NearestPart> parts = nearest_parts(product);
  const auto tightest = std::min_element(
      parts.begin(), parts.end(), [](const NearestPart& a, const NearestPart& b) { return a.distance < b.distance; });
  if (tightest == parts.end() || tightest->distance >= k_thinnest_radius + k_clearance) return std::nullopt;
  return *tightest;
}

}  // namespace

std::vector<Diagnostic> axle_clearance_warnings(
    const formats::Product& product, const std::function<std::optional<formats::Product>(const Mechanism&)>& build) {
  const std::optional<NearestPart> part = tightest_part(product);
  if (!part) return {};
  Diagnostic warning{Severity::warning, product.file.place_of("pulley.EF_mm"), {}, {}};
  warning.message = fmt::format(
      "{} is {} mm {} the pulley's flanges at theta = {} deg: at least {} mm from them is required for the thinnest "
      "axle (M3)",
      part->part, rounded(std::abs(part->distance), 3), part->distance < 0 ? "inside" : "from",
      fixed(degrees(part->theta), 1), rounded(k_thinnest_radius + k_clearance));
  const Field& field = *find_field("pulley.EF_mm");
  const double now = number_of(product.file.mechanism, field);
  double further = k_thinnest_radius + k_clearance - part->distance;
  // Another distance also changes the pulley. If the first number does not suffice, larger ones are tried.
  for (int trial = 0; trial < 3; ++trial, further *= 1.3) {
    Mechanism changed = product.file.mechanism;
    const double advised = std::ceil(now + further);
    set_number(changed, field, 0, advised);
    const auto made = build(changed);
    if (!made || tightest_part(*made)) continue;
    warning.hint = fmt::format("try pulley.EF_mm = {} or more (now {})", rounded(advised), rounded(now));
    return {warning};
  }
  warning.hint = "move the pulley away (pulley.EF_mm), or make it smaller";
  return {warning};
}

}  // namespace fusee::pipeline
