/// \file
/// Internal: parts of pulley.scad common to one-turn and multi-turn pulleys.
#pragma once

#include <string>
#include <string_view>

#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::formats::scad {

/// At most five decimals.
std::string decimal(double value);
std::string point_text(const Vec2& p);
std::string points_text(const Polygon& points);
const char* name_of(Groove groove);

/// A number of the Customizer with its slider, in mm or degrees.
struct Slider {
  const char* name;
  const char* words;  ///< comment above it in the Customizer
  double value, low, step, high;
};
std::string slider_text(const Slider& slider);

/// A number of the program without a slider.
std::string hidden(const char* name, double value, const char* words);

/// Sections of the Customizer.
std::string bore_and_hub(const Product& product);
std::string tie_offs_and_printing(const Product& product);

std::string bore_numbers(const solid::BoreLayout& bore, double compensation);
std::string screw_numbers(const solid::BodyLayout& layout, double compensation);

/// The part of the file pulley.scad in this folder for these turns: "one turn" or "several turns".
std::string program_for(std::string_view turns);

}  // namespace fusee::formats::scad
