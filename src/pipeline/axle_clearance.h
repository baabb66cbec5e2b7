/// \file
/// Internal: clearance of the turning pulley to the axle and the tendons' ends.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::pipeline {

/// Warnings about a pulley that turns into the joint's axle or into a tendon's end on the link, over the whole range.
/// None for joints with a drum, which have a condition instead, and for sheaths, whose pulley is elsewhere. `build`
/// tests the advised number: it returns a checked product, or empty.
std::vector<Diagnostic> axle_clearance_warnings(
    const formats::Product& product, const std::function<std::optional<formats::Product>(const Mechanism&)>& build);

}  // namespace fusee::pipeline
