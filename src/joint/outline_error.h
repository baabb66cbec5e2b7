/// \file
/// Pitch curves that came out of making otherwise than they were drawn: a wave along their normals, as it acts on
/// tendons and as it is drawn out.
#pragma once

#include "fusee/mechanism/imperfections.h"

namespace fusee {

/// By how much making moves a point of an outline out along its normal `psi`: s sin nψ + c cos nψ, and its derivatives.
struct OutlineWave {
  double outward = 0;  ///< mm
  double slope = 0;
  double bend = 0;
};
OutlineWave outline_wave(double psi, const OutlineError& outline);

/// What a wave of the outline adds to the curve's support, and to the arc up to there.
struct SupportWave {
  double outward = 0;
  double arc = 0;
};

SupportWave support_wave(double psi, double support, const OutlineError& outline);

}  // namespace fusee
