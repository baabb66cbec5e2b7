/// \file
/// Internal: home mark, clocking mark and labels on the end faces. mm, not yet scaled.
#pragma once

#include "solid/plan.h"

namespace fusee::solid {

/// The marks for which there is space. The layout notes omitted ones.
std::vector<Mark> marks_of(Marks kind, BodyPlan& plan);

}  // namespace fusee::solid
