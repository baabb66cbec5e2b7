/// \file
/// Pitch curves that deviate from their drawing by a wave along their normals: effect on tendons, and correction in the
/// drawing.
#pragma once

#include "fusee/mechanism.h"

namespace fusee::joint {

/// Outward displacement of an outline point along its normal `psi`, s sin nψ + c cos nψ, with derivatives.
struct OutlineWave {
  double outward = 0;  ///< w, mm
  double slope = 0;    ///< dw/dψ, mm/rad
  double bend = 0;     ///< d²w/dψ², mm/rad²
};
OutlineWave outline_wave(double psi, const OutlineError& outline);

/// Change of a curve's support and arc length due to a wave, mm. The arc is counted from ψ = 0, up to a constant.
struct SupportWave {
  double outward = 0;
  double arc = 0;
};

/// `support`: that of the curve without the wave at the normal `psi`, mm.
SupportWave support_wave(double psi, double support, const OutlineError& outline);

}  // namespace fusee::joint
