/// \file
/// Internal: flanges and walls that a printer cannot lay as one line.
#pragma once

#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/export/product.h"

namespace fusee {

/// Warnings for flanges and walls of a checked part that are thinner than print.nozzle_mm. A slicer leaves such walls
/// out, or makes them wider than they are.
std::vector<Diagnostic> walls_below_a_line(const Product& product);

}  // namespace fusee
