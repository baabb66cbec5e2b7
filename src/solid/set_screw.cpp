#include "solid/set_screw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fusee/base.h"

namespace fusee::solid {
namespace {

// Metric: clearance ISO 273 medium, tapping ISO 2306, nuts ISO 4032 (width s, thickness m), pan heads ISO 7045 (dk).
// Inch: clearance ASME B18.2.8 normal, tapping 75 % thread, nuts and pan heads ASME B18.6.3, both at their maximum.
constexpr std::array<Screw, 12> k_screws{{{"M2", 2, 2.4, 1.6, 4.0, 1.6, 4.0},
                                          {"M2.5", 2.5, 2.9, 2.05, 5.0, 2.0, 5.0},
                                          {"M3", 3, 3.4, 2.5, 5.5, 2.4, 5.6},
                                          {"M4", 4, 4.5, 3.3, 7.0, 3.2, 8.0},
                                          {"M5", 5, 5.5, 4.2, 8.0, 4.7, 9.5},
                                          {"M6", 6, 6.6, 5.0, 10.0, 5.2, 12.0},
                                          {"#2-56", 2.18, 2.59, 1.78, 4.76, 1.68, 4.24},
                                          {"#4-40", 2.84, 3.25, 2.26, 6.35, 2.49, 5.56},
                                          {"#6-32", 3.51, 3.91, 2.71, 7.94, 2.90, 6.86},
                                          {"#8-32", 4.17, 4.57, 3.45, 8.73, 3.30, 8.18},
                                          {"#10-24", 4.83, 5.23, 3.80, 9.53, 3.30, 9.47},
                                          {"1/4-20", 6.35, 7.14, 5.11, 11.11, 4.90, 12.50}}};

// Least thickness of the walls inside and outside the nut's slot, mm.
constexpr double k_least_nut_wall = 1.5;
// Length of a thread in the hub, in hole diameters.
constexpr double k_thread_ratio = 1.5;

// Thickness of the wall between the bore and the nut's slot. It carries the screw's thrust.
double nut_wall(double wall) { return std::max(wall, k_least_nut_wall); }

// Least height of the screw's axis above the hub's lower end.
double least_axis_height(const SetScrewLayout& screw) {
  return screw.nut_trap ? nut_corner(screw) : 0.5 * screw.hole_diameter;
}

}  // namespace

const Screw* find_screw(const std::string& name) {
  const auto found =
      std::find_if(k_screws.begin(), k_screws.end(), [&name](const Screw& screw) { return screw.name == name; });
  return found == k_screws.end() ? nullptr : &*found;
}

double nut_corner(const SetScrewLayout& screw) { return screw.nut_width / std::numbers::sqrt3; }
double teardrop_top(const SetScrewLayout& screw) {
  return 0.5 * screw.hole_diameter / elementary::cos(screw.ceiling_slope);
}

SetScrewLayout set_screw_layout(const Screw& screw, bool nut_trap, double compensation, double wall,
                                const BodyLayout& layout) {
  SetScrewLayout result;
  result.present = true;
  result.thread = screw.name;
  result.nut_trap = nut_trap;
  result.hole_diameter = (nut_trap ? screw.clearance : screw.tapping) + compensation;
  result.angle = 0.5 * k_pi;
  result.ceiling_slope = ridge_slope(layout);
  if (nut_trap) {
    result.nut_width = screw.nut_width + compensation;
    result.nut_thickness = screw.nut_thickness + compensation;
    result.nut_distance = layout.bore.radius + nut_wall(wall) + 0.5 * result.nut_thickness;
  }
  // The screw is in the middle of the hub. The wall above its ceiling may move it down, the nut's clearance up.
  const double middle = 0.5 * (layout.z_top + layout.z_hub), highest = layout.z_hub - teardrop_top(result) - wall;
  result.z = std::max(std::min(middle, highest), layout.z_top + least_axis_height(result));
  return result;
}

double hub_radius_for(const SetScrewLayout& screw, double bore_radius, double wall) {
  if (screw.nut_trap) return screw.nut_distance + 0.5 * screw.nut_thickness + std::max(wall, k_least_nut_wall);
  return bore_radius + std::max(wall, k_thread_ratio * screw.hole_diameter);
}

double height_to_spare(const SetScrewLayout& screw, const BodyLayout& layout, double wall) {
  // set_screw_layout() may leave exactly no clearance on one side. Rounding must not make that negative.
  constexpr double k_rounding = 1e-9;
  const double above = layout.z_hub - screw.z - teardrop_top(screw) - wall;
  const double least = std::min(above, screw.z - layout.z_top - least_axis_height(screw));
  return std::abs(least) < k_rounding ? 0.0 : least;
}

}  // namespace fusee::solid
