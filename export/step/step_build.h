/// \file
#pragma once

#include "export/step/step_part.h"
#include "fusee/export/product.h"

namespace fusee {

/// The finished pulley in the values that its STEP file is written from. InputError: too large.
StepPart step_part(const Product& product);

}  // namespace fusee
