/// \file
/// Pitch curves that deviate from their drawing by a wave along their normals: effect on tendons, and correction in the
/// drawing.
#pragma once

#include "fusee/mechanism.h"

namespace fusee::joint {

/// Outward displacement of an outline point along its normal `psi`, s sin nψ + c cos nψ, with derivatives.
struct OutlineWave {
  double outward = 0;  ///< mm
  double slope = 0;
  double bend = 0;
};
OutlineWave outline_wave(double psi, const OutlineError& outline);

/// Change of a curve's support and arc length due to a wave.
struct SupportWave {
  double outward = 0;
  double arc = 0;
};

SupportWave support_wave(double psi, double support, const OutlineError& outline);

}  // namespace fusee::joint
