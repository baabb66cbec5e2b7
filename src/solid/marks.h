/// \file
/// Home mark, clocking mark and labels on the end faces. mm, not yet scaled.
#pragma once

#include "solid/plan.h"

namespace fusee {

/// As many as there is room for; what is left out is noted in the layout.
std::vector<Mark> marks_of(Marks kind, BodyPlan& plan);

}  // namespace fusee
