/// \file
/// Internal: screws, and their choice for bearings. mm
#pragma once

#include <array>
#include <string>

#include "fusee/kit.h"

namespace fusee::kit {

// Clearance: ISO 273, fine (medium for M2). Tapping into plastic: 0.85 of the thread. Heads: ISO 4762. Nuts: ISO 4032.
inline constexpr std::array<Thread, 5> k_threads{{{"M2", 2, 2.3, 1.7, 1.9, 4.0, 1.6},
                                                  {"M3", 3, 3.3, 2.6, 2.75, 5.5, 2.4},
                                                  {"M4", 4, 4.3, 3.4, 3.5, 7.0, 3.2},
                                                  {"M5", 5, 5.3, 4.3, 4.25, 8.0, 4.7},
                                                  {"M8", 8, 8.4, 6.9, 6.5, 13.0, 6.8}}};

/// The largest thread no thicker than `diameter`, or the smallest one.
const Thread& thread_within(double diameter);
/// Distance from the centre of a nut to its corner.
double nut_corner_radius(const Thread& thread);
/// Name with the next stock length, such as "M3 × 16".
std::string screw_words(const Thread& thread, double length);
/// The next stock length, mm.
double stock_length(double length);

}  // namespace fusee::kit
