/// \file
/// Internal: set screws and their nuts. mm.
#pragma once

#include <string>

#include "fusee/solid.h"

namespace fusee::solid {

/// Sizes of one thread.
struct Screw {
  const char* name;
  double nominal;    ///< diameter
  double clearance;  ///< diameter of a clearance hole
  double tapping;    ///< diameter of a tapping hole
  double nut_width;  ///< across flats
  double nut_thickness;
  double head;  ///< diameter of a pan head
};

/// "M2" … "M6", "#2-56" … "1/4-20"; null for any other name.
const Screw* find_screw(const std::string& name);

/// Hole and nut trap in the hub, at half its height or as high as the nut requires. `layout` must have its heights and
/// bore.
SetScrewLayout set_screw_layout(const Screw& screw, bool nut_trap, double compensation, double wall,
                                const BodyLayout& layout);

/// The hub radius that leaves `wall`, and at least 1.5 mm, outside the nut. Without a nut, the thread is 1.5 hole
/// diameters long, and at least `wall`.
double hub_radius_for(const SetScrewLayout& screw, double bore_radius, double wall);

/// Clearance of the set screw's features within the hub's height, negative when they do not fit, mm.
double height_to_spare(const SetScrewLayout& screw, const BodyLayout& layout, double wall);

/// Distance from the nut's centre (the screw's axis) to the corner that points down.
double nut_corner(const SetScrewLayout& screw);
/// Height of the ceiling's ridge above the axis of the screw's hole. The ceiling rises to the ridge at ceiling_slope on
/// both sides, so that it prints without support.
double teardrop_top(const SetScrewLayout& screw);

}  // namespace fusee::solid
