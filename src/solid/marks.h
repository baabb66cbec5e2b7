/// \file
/// Home mark, clocking mark and labels on the end faces. mm, not yet scaled.
#pragma once

#include "solid/plan.h"

namespace fusee {

struct Mark {
  std::vector<Polygon> loops;  ///< loops[0] without the others
  bool on_top = true;          ///< else on the face on the bed
};

/// As many as there is room for; what is left out is noted in the layout.
std::vector<Mark> marks_of(Marks kind, BodyPlan& plan);

}  // namespace fusee
