// Tables for a spreadsheet: comma-separated, with a header line that has the units in the names, and six decimals.
// Missing numbers are empty cells.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "export/report/csv_cells.h"
#include "export/report/report.h"
#include "fusee/base.h"
#include "fusee/transmission.h"

namespace fusee::formats {
namespace {

constexpr double k_none = std::numeric_limits<double>::quiet_NaN();

void put_row(std::string& table, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) table += ',';
    table += csv_cell(values[i]);
  }
  table += '\n';
}

/// The normal of a closed curve turns once from its first to its last point, and its height is constant.
void put_outline(std::string& table, const profile::Outline& outline, double z) {
  const std::string pulley = std::string(transmission::pulley_name(outline.side)) + ",";
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const profile::OutlinePoint& point = outline.points[i];
    const double angle = elementary::atan2(point.position.y(), point.position.x());
    table += pulley + csv_cell(degrees(angle)) + ',' + csv_cell(point.position.x()) + ',' +
             csv_cell(point.position.y()) + ',' + csv_cell(point.curvature_radius) +
             (outline.is_active(i) ? ",1," : ",0,") + csv_cell(degrees(point.psi)) + ',' +
             csv_cell(degrees(point.psi)) + ',' + csv_cell(z) + '\n';
  }
}

void put_spiral(std::string& table, transmission::Side side, const helix::Spiral& spiral,
                const helical_solid::SpiralPlace& place) {
  const std::string pulley = std::string(transmission::pulley_name(side)) + ",";
  for (std::size_t i = 0; i < spiral.rows.size(); ++i) {
    const helix::SpiralRow& row = spiral.rows[i];
    const bool is_used = i >= spiral.first_used && i <= spiral.last_used;
    table += pulley + csv_cell(degrees(elementary::atan2(row.y, row.x))) + ',' + csv_cell(row.x) + ',' +
             csv_cell(row.y) + ',' + csv_cell(row.rho) + (is_used ? ",1," : ",0,") +
             csv_cell(degrees(std::remainder(row.turn, k_two_pi))) + ',' + csv_cell(degrees(row.turn)) + ',' +
             csv_cell(place.height(row.z)) + '\n';
  }
}

/// Ratio of a planar force to the tension along the sloped path, for the tendon that carries the load.
double slope_cosine(const Product& product, std::size_t i, const transmission::PaperForces& forces) {
  if (!product.helix) return 1.0;
  const std::size_t loaded_side = forces.T2 > 0 ? 1 : 0;
  return elementary::cos(product.helix->synthesis.sides.at(loaded_side).stroke[i].slope);
}

void add_slopes(std::vector<double>& row, const HelixProduct& helix, std::size_t i) {
  for (const helix::HelixSide& side : helix.synthesis.sides) {
    row.push_back(degrees(side.stroke[i].slope));
    row.push_back(degrees(side.stroke[i].fleet));
  }
}

/// Results of the tendons wound on the mesh, at one α.
struct AsBuilt {
  double theta = k_none;   ///< rad
  double excess = k_none;  ///< excess length of tendon 2, mm
};

/// The rewound pulley at `alpha`, interpolated; empty outside its points.
AsBuilt as_built_at(const std::vector<profile::RewindPoint>& points, double alpha) {
  constexpr double k_same_alpha = 1e-9;
  const auto right = std::lower_bound(points.begin(), points.end(), alpha - k_same_alpha,
                                      [](const profile::RewindPoint& point, double a) { return point.alpha < a; });
  if (right == points.end()) return {};
  if (std::abs(right->alpha - alpha) <= k_same_alpha) return {right->theta, right->excess};
  if (right == points.begin()) return {};
  const auto left = right - 1;
  const double t = (alpha - left->alpha) / (right->alpha - left->alpha);
  return {std::lerp(left->theta, right->theta, t), std::lerp(left->excess, right->excess, t)};
}

}  // namespace

/// angle_deg: direction of the point from the axis. normal_deg: direction of the tendon's outward normal there. Both
/// counter-clockwise from x at home. active: 1 on the active arc. turn_deg: the normal's direction unrolled over all
/// turns, increasing from row to row. z_mm: height of the tendon's centre line above the part's lower face, in the
/// finished part.
std::string profile_csv(const Product& product) {
  std::string table = "pulley,angle_deg,x_mm,y_mm,radius_of_curvature_mm,active,normal_deg,turn_deg,z_mm\n";
  if (product.helix) {
    const HelixProduct& helix = *product.helix;
    put_spiral(table, transmission::Side::left, helix.synthesis.sides[0].spiral, helix.pulley.p1);
    put_spiral(table, transmission::Side::right, helix.synthesis.sides[1].spiral, helix.pulley.p2);
    return table;
  }
  put_outline(table, product.synthesis.p1, product.pulley.layout.z_p1);
  put_outline(table, product.synthesis.p2, product.pulley.layout.z_p2);
  return table;
}

/// Coordinates as in profile_csv(). Programs that make a closed spline of a table require the first point again at the
/// end.
std::string pitch_curve_csv(const Product& product, transmission::Side side) {
  const bool left = side == transmission::Side::left;
  std::string table = "x_mm,y_mm,z_mm\n";
  const auto put = [&table](double x, double y, double z) { put_row(table, std::array{x, y, z}); };
  if (product.helix) {
    const helical_solid::SpiralPlace& place = left ? product.helix->pulley.p1 : product.helix->pulley.p2;
    for (const helix::SpiralRow& row : product.helix->synthesis.sides[left ? 0 : 1].spiral.rows)
      put(row.x, row.y, place.height(row.z));
    return table;
  }
  const solid::BodyLayout& layout = product.pulley.layout;
  const double z = left ? layout.z_p1 : layout.z_p2;
  const Polygon curve = profile::parallel(left ? product.synthesis.p1 : product.synthesis.p2, 0);
  for (const Vec2& point : curve) put(point.x(), point.y(), z);
  if (!curve.empty()) put(curve.front().x(), curve.front().y(), z);
  return table;
}

/// r1 and r2: moment arms of the tendons about the pulley's axis; m1 and m2: about the joint. Forces as in
/// fusee/transmission.h. theta_as_built_deg and slack_mm are results of the tendons wound on the written mesh. A
/// multi-turn pulley adds the slope and the fleet angle of both tendons.
std::string transmission_csv(const Product& product) {
  std::string table =
      "alpha_deg,theta_deg,r1_mm,r2_mm,m1_mm,m2_mm,gamma2_deg,T2_N,phi_deg,Tb_N,elongation_mm,theta_error_deg,"
      "theta_as_built_deg,slack_mm\n";
  if (product.helix) {
    table.back() = ',';
    table += "slope1_deg,fleet1_deg,slope2_deg,fleet2_deg\n";
  }
  for (std::size_t i = 0; i < product.synthesis.stroke.size(); ++i) {
    const transmission::TransmissionPoint& point = product.synthesis.stroke[i];
    const transmission::PaperForces forces = transmission::paper_forces(product.joint.mechanism, point);
    const AsBuilt as_built = as_built_at(product.as_built.points, point.alpha);
    const double cosine = slope_cosine(product, i, forces);
    std::vector<double> row = {degrees(point.alpha),
                               degrees(point.theta),
                               point.t1.p,
                               point.t2.p,
                               point.t1.m,
                               point.t2.m,
                               degrees(forces.gamma2),
                               forces.T2 / cosine,
                               degrees(forces.phi),
                               forces.Tb / cosine,
                               forces.elongation,
                               degrees(forces.theta_error),
                               degrees(as_built.theta),
                               as_built.excess};
    if (product.helix) add_slopes(row, *product.helix, i);
    put_row(table, row);
  }
  return table;
}

}  // namespace fusee::formats
