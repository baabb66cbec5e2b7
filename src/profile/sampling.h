/// \file
/// Sampling of both pitch curves at common normal directions, with bounded sagitta of the chords.
#pragma once

#include <array>

#include "fusee/profile.h"
#include "profile/pitch_curve.h"

namespace fusee::profile {

struct SamplingOptions {
  double chord_error_mm = 0.01;  ///< largest sagitta, mm
  double reach = 0;              ///< outward offset of the outermost parallel curve that must satisfy the tolerance, mm
  /// Maximum turn of a chord at any tolerance. A string wound on the polygon is then accurate to 5e-5 of its length.
  double largest_turn = radians(2.0);
};

/// Outlines of P1 and P2. `left` is P1's curve in its right-hand image.
std::array<Outline, 2> sample(const PitchCurve& left, const PitchCurve& right, const SamplingOptions& options);

}  // namespace fusee::profile
