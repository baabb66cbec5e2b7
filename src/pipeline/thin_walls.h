/// \file
/// Internal: flanges and walls thinner than one printed line.
#pragma once

#include <vector>

#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::pipeline {

/// Warnings about flanges and walls of a checked part that are thinner than print.nozzle_mm. A slicer omits or widens
/// such walls.
std::vector<Diagnostic> thin_wall_warnings(const formats::Product& product);

}  // namespace fusee::pipeline
