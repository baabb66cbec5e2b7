/// \file
/// Internal: parts that are far wider than their tendons require.
#pragma once

#include <optional>

#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::pipeline {

/// A warning about a pulley of one turn that reaches twice as far as its hub and the largest radius at which a tendon
/// leaves it. Such an outline closes in long, pointed wings outside the range. Empty for other parts.
std::optional<Diagnostic> wide_part_warning(const formats::Product& product);

}  // namespace fusee::pipeline
