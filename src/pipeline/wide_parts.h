/// \file
/// Internal: parts that are far wider than their tendons require.
#pragma once

#include <optional>

#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::pipeline {

/// A warning about a pulley of one turn whose radius is at least twice that of its hub, and at least twice the largest
/// of r1 and r2. Such an outline closes in long, pointed wings outside the range. Empty for other parts.
std::optional<Diagnostic> wide_part_warning(const formats::Product& product);

}  // namespace fusee::pipeline
