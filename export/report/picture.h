/// \file
/// Internal: an SVG as PNG or PDF, drawn by the system's librsvg and cairo. They are loaded on demand, so that nothing
/// else depends on them.
#pragma once

#include <string>

namespace fusee::formats {

/// A PNG on white, with two dots for each pixel of the SVG. Throws InputError if the libraries are not installed, or
/// fail.
std::string png_of(const std::string& svg, double width, double height);
/// A PDF with one page of the SVG's size, at 96 pixels an inch. Throws like png_of().
std::string pdf_of(const std::string& svg, double width, double height);

}  // namespace fusee::formats
