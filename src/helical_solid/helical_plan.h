/// \file
/// Internal: the values a helical pulley was built from, for other representations (export/step). mm, not yet scaled.
#pragma once

#include <array>

#include "fusee/helical_solid.h"
#include "helical_solid/helical_blank.h"
#include "helical_solid/run_out.h"
#include "helical_solid/winding.h"

namespace fusee::helical_solid {

struct HelicalPlan {
  Fan fan;
  HelicalSection section;
  RingHeights heights;
  std::array<GrooveEnd, 2> ends;  ///< the ends at which the tendons are tied: P1's last, P2's first
  std::array<RunOutSizes, 2> run_outs;
};

}  // namespace fusee::helical_solid
