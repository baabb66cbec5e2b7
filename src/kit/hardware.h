/// \file
/// Internal: screws, and their choice for bearings. mm
#pragma once

#include <array>
#include <string>

#include "fusee/kit.h"

namespace fusee::kit {

// In the order of Thread. Clearance: ISO 273, fine, and 0.1 mm more for M2 and M3. Tapping into plastic: 0.85 of the
// thread. Heads: ISO 4762. Nuts: ISO 4032.
inline constexpr std::array<Thread, 5> k_threads{{{"M2", 2, 2.3, 1.7, 1.9, 4.0, 1.6},
                                                  {"M3", 3, 3.3, 2.6, 2.75, 5.5, 2.4},
                                                  {"M4", 4, 4.3, 3.4, 3.5, 7.0, 3.2},
                                                  {"M5", 5, 5.3, 4.3, 4.25, 8.0, 4.7},
                                                  {"M8", 8, 8.4, 6.9, 6.5, 13.0, 6.8}}};

/// Screws of inch files. Clearance: ASME B18.2.8, normal. Tapping as above. Heads: ASME B18.3. Nuts: ASME B18.6.3.
inline constexpr std::array<Thread, 5> k_inch_threads{{{"#2-56", 2.18, 2.44, 1.85, 1.78, 4.76, 1.6},
                                                       {"#4-40", 2.84, 3.2, 2.4, 2.32, 6.35, 2.4},
                                                       {"#6-32", 3.51, 3.8, 3.0, 2.87, 7.94, 2.8},
                                                       {"#8-32", 4.17, 4.5, 3.55, 3.43, 8.73, 3.2},
                                                       {"#10-32", 4.83, 5.1, 4.1, 3.96, 9.53, 3.2}}};
/// Threads of the file's unit, the thinnest first.
constexpr const std::array<Thread, 5>& threads_of(LengthUnit units) {
  return units == LengthUnit::inch ? k_inch_threads : k_threads;
}

/// The thickest thread that is no thicker than `diameter`, or the thinnest of all if there is none.
const Thread& thread_within(double diameter, LengthUnit units = LengthUnit::mm);
/// Distance from the centre of a nut to its corner.
double nut_corner_radius(const Thread& thread);
/// Name with the shortest stock length of at least `length`, mm: "M3 × 16" or "#4-40 × 5/8 in".
std::string screw_words(const Thread& thread, double length);
/// The shortest metric stock length of at least `length`, mm.
double stock_length(double length);

}  // namespace fusee::kit
