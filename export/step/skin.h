/// \file
/// Internal: the faces of a multi-turn pulley for its STEP file.
#pragma once

#include "export/step/groove_section.h"
#include "export/step/step_part.h"
#include "fusee/export.h"

namespace fusee::formats {

/// The body of a multi-turn pulley as printed, with shrinkage compensation. Throws InputError if it is too large.
StepSkin helical_skin(const Product& product);

/// The run-outs to the knots, not yet scaled. They are cut in addition to the features of every pulley.
std::vector<StepTool> run_out_cuts(const Product& product);

}  // namespace fusee::formats
