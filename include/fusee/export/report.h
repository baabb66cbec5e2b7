/// \file
/// A finished pulley in words and numbers: tables, a program, a page for a person and one for programs. The same input
/// gives the same bytes.
#pragma once

#include <string>
#include <vector>

#include "fusee/base/files.h"
#include "fusee/export/product.h"

namespace fusee {

std::string profile_csv(const Product& product);
/// One pitch curve as points for a CAD program's spline: x_mm, y_mm, z_mm. Closed ones end where they begin.
std::string pitch_curve_csv(const Product& product, Side side);
std::string transmission_csv(const Product& product);
/// The part as an OpenSCAD program that a person can read and change.
std::string scad_text(const Product& product);
/// One page that needs nothing else: drawings, plots, checks.
std::string report_html(const Product& product);
/// `outputs` are the files beside it.
std::string manifest_json(const Product& product, const std::vector<OutputFile>& outputs);

}  // namespace fusee
