/// \file
/// Internal: changes of one number that bring omitted features of the body back.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::pipeline {

/// Features that a full build of a changed mechanism omits; empty if the build fails.
using BuildOmissions = std::function<std::optional<std::vector<std::string>>(const Mechanism&)>;

/// The notes of product.pulley.layout, each about an omission with a number that was built and brings the feature back.
/// Plans pick the numbers, `build` proves them. Reads `product` only.
std::vector<std::string> notes_with_advice(const formats::Product& product, const BuildOmissions& build,
                                           const RunContext& context);

}  // namespace fusee::pipeline
