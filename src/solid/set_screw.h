/// \file
/// Set screws and their nuts. mm.
#pragma once

#include <string>

#include "fusee/solid/layout.h"

namespace fusee {

/// Sizes of one thread.
struct Screw {
  const char* name;
  double nominal;    ///< diameter
  double clearance;  ///< hole that the screw passes
  double tapping;    ///< hole that the screw's thread is cut into
  double nut_width;  ///< across flats
  double nut_thickness;
  double head;  ///< diameter of a pan head
};

/// "M2" … "M6"; null for any other name.
const Screw* find_screw(const std::string& name);

/// Hole and nut trap in a hub on `bore`, at half the hub's height or as high as the nut needs; `layout` has its heights
/// and bore already.
SetScrewLayout set_screw_layout(const Screw& screw, bool nut_trap, double compensation, double wall,
                                const BodyLayout& layout);

/// The hub's radius that leaves `wall` outside of the nut, or outside of three turns of thread.
double hub_radius_for(const SetScrewLayout& screw, double bore_radius, double wall);

/// How far the set screw's features stay within the hub's height: negative when they do not fit, mm.
double height_to_spare(const SetScrewLayout& screw, const BodyLayout& layout, double wall);

/// From the nut's middle (the screw's axis) to the corner that points down.
double nut_corner(const SetScrewLayout& screw);
/// A horizontal hole's roof rises to a corner, at roof_slope on both sides, so that it prints without support.
double teardrop_top(const SetScrewLayout& screw);

}  // namespace fusee
