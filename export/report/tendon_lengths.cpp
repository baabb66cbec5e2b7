#include "export/report/tendon_lengths.h"

#include <algorithm>
#include <cmath>

#include "export/report/tendon_trace.h"
#include "solid/wrap.h"

namespace fusee::formats {
namespace {

// Length at one end: a figure-eight stopper knot takes about a dozen diameters (assumed), and a tail pulls it tight.
constexpr double k_knot_ratio = 12.0;  // length of the knot per tendon diameter
constexpr double k_tail = 50.0;        // mm
constexpr double k_cut_step = 5.0;     // mm

TendonLength length_to(const Product& product, const solid::Anchor& anchor) {
  const Mechanism& mechanism = product.joint.mechanism;
  const bool left = anchor.side == transmission::Side::left;
  const profile::Outline& outline = left ? product.synthesis.p1 : product.synthesis.p2;
  const transmission::TransmissionPoint& home = *product.synthesis.home();
  const transmission::TendonPoint& tendon = left ? home.t1 : home.t2;
  const solid::BodyLayout& layout = product.pulley.layout;

  const bool sheathed = mechanism.sheath.is_there();
  const double rho = sheathed ? 0.0 : mechanism.seen_pitch_radius();
  const Vec2 pin = sheathed ? sheath_exit(mechanism, anchor.side) : pin_centre(mechanism, anchor.side);
  const Vec2 axis = pulley_axis(mechanism);
  // The nearest sampled point suffices: a step along the tangent lengthens the arc by as much as it shortens the span.
  const std::size_t contact = solid::index_at_normal(outline, tendon.lower_normal);
  const double to_pin = (pin - axis - outline.points[contact].position).norm();
  const double lower_span = std::sqrt(std::max(0.0, (to_pin - rho) * (to_pin + rho)));

  // The channel leaves the floor at `anchor.exit`. The tendon leaves the pitch curve at its point nearest to that.
  const std::size_t exit = solid::index_at_place(outline, anchor.exit);
  const double above_pulley = tendon.length - tendon.lower_reach;
  TendonLength result;
  result.side = anchor.side;
  result.joint_knot = attachment(mechanism, anchor.side, 0.0);
  const double groove = left ? layout.z_p1 : layout.z_p2, z = anchor.seat ? anchor.seat->z : groove;
  result.pulley_knot = layout.scale * Vec3(anchor.pocket.x(), anchor.pocket.y(), z);
  const solid::WoundArc wound = solid::wound_arc(outline, contact, exit);
  result.between_knots =
      above_pulley + lower_span + wound.length + (anchor.pocket - anchor.exit).norm() + std::abs(z - groove);
  result.cut = cut_length(result.between_knots + 2.0 * tendon_end(mechanism.tendon));
  result.lap_at_home = wound.turn;
  result.spare_lap = solid::wound_arc(outline, outline.anchor_end(), exit).turn;
  return result;
}

/// The length along the sloped path and the groove, then straight from the groove's end to the pocket.
TendonLength length_on_helix(const Product& product, const helical_solid::HelicalAnchor& anchor) {
  const bool left = anchor.side == transmission::Side::left;
  const helix::HelixSide& side = product.helix->synthesis.sides.at(left ? 0 : 1);
  const std::vector<helix::SpiralRow>& rows = side.spiral.rows;
  const auto home = std::min_element(side.stroke.begin(), side.stroke.end(), [](const auto& a, const auto& b) {
    return std::abs(a.wound) < std::abs(b.wound);
  });
  // P1's tendon stays wound at its spiral's last row, P2's at its first.
  const helix::SpiralRow& end = left ? rows.back() : rows.front();
  const double rise = end.z - home->z;
  TendonLength result;
  result.side = anchor.side;
  result.joint_knot = attachment(product.joint.mechanism, anchor.side, 0.0);
  result.pulley_knot = product.pulley.layout.scale * anchor.pocket;
  result.between_knots =
      home->free + elementary::hypot(rise, rise / side.spiral.slope) + (anchor.pocket - anchor.exit).norm();
  result.cut = cut_length(result.between_knots + 2.0 * tendon_end(product.joint.mechanism.tendon));
  result.lap_at_home = std::abs(end.turn - side.spiral.row_at(home->z).turn);
  const helix::SpiralRow& last_used = rows.at(left ? side.spiral.last_used : side.spiral.first_used);
  result.spare_lap = std::abs(end.turn - last_used.turn);
  return result;
}

}  // namespace

double tendon_end(const Tendon& tendon) { return k_knot_ratio * tendon.diameter + k_tail; }
double cut_length(double needed) { return k_cut_step * std::ceil(needed / k_cut_step); }

std::vector<TendonLength> tendon_lengths(const Product& product) {
  std::vector<TendonLength> lengths;
  if (product.synthesis.stroke.empty()) return lengths;
  if (product.helix) {
    for (const helical_solid::HelicalAnchor& anchor : product.helix->pulley.anchors)
      lengths.push_back(length_on_helix(product, anchor));
    return lengths;
  }
  for (const solid::Anchor& anchor : product.pulley.anchors) {
    if (anchor.wound_end) lengths.push_back(length_to(product, anchor));
  }
  return lengths;
}

}  // namespace fusee::formats
