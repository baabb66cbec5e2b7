/// \file
/// A finished pulley as tables, an OpenSCAD program, a page and a manifest. The same input gives the same bytes.
#pragma once

#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::formats {

std::string profile_csv(const Product& product);
/// One pitch curve as points for a CAD program's spline: x_mm, y_mm, z_mm. Closed curves repeat their first point.
std::string pitch_curve_csv(const Product& product, transmission::Side side);
std::string transmission_csv(const Product& product);
/// The part as a readable, editable OpenSCAD program.
std::string scad_text(const Product& product);
/// A self-contained page: drawings, plots, checks.
std::string report_html(const Product& product);
/// `outputs`: the other written files.
std::string manifest_json(const Product& product, const std::vector<OutputFile>& outputs);

}  // namespace fusee::formats
