/// \file
#pragma once

#include "export/step/groove_section.h"
#include "export/step/step_part.h"
#include "fusee/export/product.h"

namespace fusee {

/// The body of a pulley of several turns, not scaled yet. InputError: too large.
StepSkin helical_skin(const Product& product);

/// What is cut out of it beside what every pulley has: the ways to the knots.
std::vector<StepTool> run_out_cuts(const Product& product);

}  // namespace fusee
