/// \file
/// Internal: the figures of a multi-turn pulley's report, in place of plane drawings.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "export/report/plot.h"
#include "export/report/svg.h"
#include "fusee/export.h"

namespace fusee::formats {

inline constexpr std::string_view k_helix_words =
    "<p class=\"lead\">Both tendons are wound several times, and their take-offs move along the axis. "
    "Heights are above the part’s lower face. The fleet angle is the angle between a tendon’s path and its groove at "
    "the take-off.</p>\n";
inline constexpr std::string_view k_spiral_words =
    "<p class=\"lead\">Pitch curves in plan, at home: the working arc, and, thin, the spare turns at both ends. "
    "Radii are measured to the tendon’s centre line, before the scale for shrinkage.</p>\n";
inline constexpr std::string_view k_winding_words =
    "Hold the joint at home. Knot tendon 1 into the pocket of the lower face, wind it up the lower groove to where it "
    "leaves at home and lead it over the outer side of pin B to its end on the joint; tendon 2 likewise from the "
    "pocket of the upper face, down the upper groove, over pin D.";

/// Required heights of the tendons' ends.
std::string helix_heights(const Product& product);
/// Heights of the take-offs and fleet angles over α.
std::vector<Plot> helix_plots(const Product& product);
/// One pitch curve in plan, to scale.
Figure spiral_figure(const Product& product, transmission::Side side);

}  // namespace fusee::formats
