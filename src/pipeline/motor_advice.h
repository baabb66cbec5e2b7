/// \file
/// Internal: advice on a motor that cannot do what its joint requires.
#pragma once

#include "fusee/export.h"
#include "fusee/pipeline.h"

namespace fusee::pipeline {

/// Changes of a feasible pulley with which the motor suffices, each confirmed by a full build. product.joint and
/// product.synthesis must be designed, and product.pulley too if `product` has a helix.
profile::Advice motor_advice(const formats::Product& product, const BuildOptions& options, const RunContext& context);

}  // namespace fusee::pipeline
