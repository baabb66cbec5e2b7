/// \file
/// How well a ceiling that hangs too flatly can be printed over air: bridges along one direction, and what stands out
/// beyond them. mm.
#pragma once

#include "fusee/solid/print.h"
#include "solid/hanging.h"

namespace fusee {

struct Reach {
  double bridge = 0;  ///< longest span, both ends held; 0: none is needed
  Vec3 bridge_at = Vec3::Zero();
  double step = 0;  ///< furthest from what holds it: a held edge or a bridge
  Vec3 step_at = Vec3::Zero();

  bool within(const PrintLimits& limits) const { return bridge <= limits.bridge && step <= limits.step; }
};

/// Along the direction that suits the patch best, as a slicer chooses it.
Reach reach_of(const HangingPatch& patch, const PrintLimits& limits);

}  // namespace fusee
