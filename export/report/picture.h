/// \file
/// An SVG as PNG or PDF. librsvg and cairo of the system draw it; they are loaded for this alone, so that nothing else
/// depends on them.
#pragma once

#include <string>

namespace fusee {

/// On white, two dots a pixel of the SVG. InputError where the libraries are not installed, or refuse.
std::string png_of(const std::string& svg, double width, double height);
/// One page of the SVG's size, 96 of its pixels an inch. The same errors.
std::string pdf_of(const std::string& svg, double width, double height);

}  // namespace fusee
