/// \file
/// Internal: a pulley as the plain values that the OpenCASCADE module converts.
#pragma once

#include "export/step/step_part.h"
#include "fusee/export.h"

namespace fusee::formats {

/// The finished pulley in the plain values of its STEP file. Throws InputError if it is too large.
StepPart step_part(const Product& product);

}  // namespace fusee::formats
