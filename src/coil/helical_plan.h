/// \file
/// Internal: the values a helical pulley was built from, for other representations (export/step). mm, not yet scaled.
#pragma once

#include <array>

#include "coil/helical_blank.h"
#include "coil/run_out.h"
#include "coil/winding.h"
#include "fusee/coil.h"

namespace fusee::coil {

struct HelicalPlan {
  Fan fan;
  HelicalSection section;
  RingHeights heights;
  std::array<GrooveEnd, 2> ends;  ///< the ends at which the tendons are tied: P1's last, P2's first
  std::array<RunOutSizes, 2> run_outs;
};

}  // namespace fusee::coil
