/// \file
/// What a helical pulley was made from, for what draws it once more by other means (export/step). mm, not yet scaled.
#pragma once

#include <array>

#include "coil/helical_blank.h"
#include "coil/run_out.h"
#include "coil/winding.h"
#include "fusee/coil/helical_pulley.h"

namespace fusee {

struct HelicalPlan {
  Fan fan;
  HelicalSection section;
  RingHeights heights;
  std::array<GrooveEnd, 2> ends;  ///< at which the tendons are tied: P1's last, P2's first
  std::array<RunOutSizes, 2> run_outs;
};

}  // namespace fusee
