/// \file
/// Internal: samples a spiral's curve as rows.
#pragma once

#include "helix/pitch_spiral.h"

namespace fusee::helix {

/// Accuracy of draw_spiral().
struct SpiralDrawing {
  double chord_error_mm = 0.01;        ///< largest sagitta of a chord, mm
  double reach = 0;                    ///< distance of the outermost parallel curve that keeps the tolerance, mm
  double largest_turn = radians(1.5);  ///< largest angle from row to row, rad
};

/// The rows of a curve with its spare turns, in the pulley's frame: P1's mirrored curve is mirrored back. `slope`:
/// tan λ of the groove.
Spiral draw_spiral(const PitchSpiral& curve, transmission::Side side, double slope, const SpiralDrawing& drawing);

}  // namespace fusee::helix
