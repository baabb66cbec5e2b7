/// \file
/// Both pitch curves, sampled at common directions of the normal so that no chord leaves its curve by more than a
/// tolerance.
#pragma once

#include <array>

#include "fusee/profile/outline.h"
#include "profile/pitch_curve.h"

namespace fusee {

struct SamplingOptions {
  double tolerance = 0.01;  ///< largest sagitta, mm
  double reach = 0;         ///< of the outermost parallel curve that must keep it, outward from the pitch curve, mm
  /// However coarse the tolerance, a chord turns no further: a string wound on the polygon is then right to 5e-5 of its
  /// length.
  double largest_turn = radians(2.0);
};

/// P1 (from its right-hand image `left`) and P2.
std::array<Outline, 2> sample(const PitchCurve& left, const PitchCurve& right, const SamplingOptions& options);

}  // namespace fusee
