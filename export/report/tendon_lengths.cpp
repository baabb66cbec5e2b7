#include "export/report/tendon_lengths.h"

#include <algorithm>
#include <cmath>

#include "export/report/tendon_trace.h"
#include "fusee/base/units.h"

namespace fusee {
namespace {

/// In (−π, π].
double turn_between(double from, double to) { return std::remainder(to - from, k_two_pi); }

/// Where the outline's normal is nearest to `normal`. Nearest is enough: what a step along the tangent adds to the arc
/// it takes from the span.
std::size_t index_at_normal(const Outline& outline, double normal) {
  const auto found =
      std::min_element(outline.points.begin(), outline.points.end(), [normal](const auto& a, const auto& b) {
        return std::abs(turn_between(a.psi, normal)) < std::abs(turn_between(b.psi, normal));
      });
  return static_cast<std::size_t>(found - outline.points.begin());
}

std::size_t index_at_place(const Outline& outline, const Vec2& place) {
  const auto found =
      std::min_element(outline.points.begin(), outline.points.end(), [&place](const auto& a, const auto& b) {
        return (a.position - place).squaredNorm() < (b.position - place).squaredNorm();
      });
  return static_cast<std::size_t>(found - outline.points.begin());
}

/// Along the outline from one point to another in the sense in which the tendon is wound: counter-clockwise on P1,
/// clockwise on P2.
struct Arc {
  double length = 0;
  double turn = 0;
};
Arc wound_arc(const Outline& outline, std::size_t from, std::size_t to) {
  const std::size_t count = outline.points.size();
  const std::size_t step = outline.side == Side::left ? 1 : count - 1;
  Arc arc;
  for (std::size_t i = from; i != to;) {
    const std::size_t next = (i + step) % count;
    arc.length += (outline.points[next].position - outline.points[i].position).norm();
    arc.turn += std::abs(turn_between(outline.points[i].psi, outline.points[next].psi));
    i = next;
  }
  return arc;
}

TendonLength length_to(const Product& product, const Anchor& anchor) {
  const Mechanism& mechanism = product.joint.mechanism;
  const bool left = anchor.side == Side::left;
  const Outline& outline = left ? product.synthesis.p1 : product.synthesis.p2;
  const TransmissionPoint& home = *product.synthesis.home();
  const TendonPoint& tendon = left ? home.t1 : home.t2;
  const BodyLayout& layout = product.pulley.layout;

  const double rho = mechanism.seen_pitch_radius();
  const Vec2 pin = pin_centre(mechanism, anchor.side);
  const Vec2 axis = pulley_axis(mechanism);
  const std::size_t contact = index_at_normal(outline, tendon.lower_normal);
  const double to_pin = (pin - axis - outline.points[contact].position).norm();
  const double lower_span = std::sqrt(std::max(0.0, (to_pin - rho) * (to_pin + rho)));

  // The channel's centre line leaves the floor; the tendon's centre line, the pitch curve above it.
  const std::size_t exit = index_at_place(outline, anchor.exit);
  const double above_pulley = tendon.length - tendon.lower_reach;
  TendonLength result;
  result.side = anchor.side;
  result.joint_knot = attachment(mechanism, 0.0);
  const double z = left ? layout.z_p1 : layout.z_p2;
  result.pulley_knot = layout.scale * Vec3(anchor.pocket.x(), anchor.pocket.y(), z);
  result.between_knots =
      above_pulley + lower_span + wound_arc(outline, contact, exit).length + (anchor.pocket - anchor.exit).norm();
  result.spare_lap = wound_arc(outline, outline.anchor_end(), exit).turn;
  return result;
}

}  // namespace

std::vector<TendonLength> tendon_lengths(const Product& product) {
  std::vector<TendonLength> lengths;
  if (product.synthesis.stroke.empty()) return lengths;
  for (const Anchor& anchor : product.pulley.anchors) {
    if (anchor.wound_end) lengths.push_back(length_to(product, anchor));
  }
  return lengths;
}

}  // namespace fusee
