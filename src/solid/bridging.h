/// \file
/// Internal: support of too flat ceilings over air, by bridges along one direction and by overhangs beyond them. mm.
#pragma once

#include "solid/overhangs.h"
#include "solid/print.h"

namespace fusee::solid {

/// The longest unsupported lengths of a ceiling, and where they are.
struct SupportGaps {
  double bridge = 0;  ///< longest required span supported at both ends; 0: none required
  Vec3 bridge_at = Vec3::Zero();
  double step = 0;  ///< longest distance from a supported edge or a bridge
  Vec3 step_at = Vec3::Zero();

  bool within(const PrintLimits& limits) const { return bridge <= limits.bridge && step <= limits.step; }
};

/// The gaps with bridges in the patch's most favourable direction, which a slicer chooses too.
SupportGaps support_gaps_of(const OverhangPatch& patch, const PrintLimits& limits);

}  // namespace fusee::solid
