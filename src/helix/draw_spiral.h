/// \file
/// Internal: samples a spiral's curve as rows.
#pragma once

#include "helix/pitch_spiral.h"

namespace fusee::helix {

struct SpiralDrawing {
  double chord_error_mm = 0.01;        ///< sagitta, mm
  double reach = 0;                    ///< distance of the outermost parallel curve that keeps the tolerance, mm
  double largest_turn = radians(1.5);  ///< largest angle from row to row
};

Spiral draw_spiral(const PitchSpiral& curve, transmission::Side side, double slope, const SpiralDrawing& drawing);

}  // namespace fusee::helix
