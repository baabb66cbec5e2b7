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

/// A full build of a changed mechanism.
struct BuiltTrial {
  std::vector<std::string> omitted;  ///< features
  std::string cost;                  ///< costs()
};

/// Builds a changed mechanism; empty if the build fails.
using BuildOmissions = std::function<std::optional<BuiltTrial>(const Mechanism&)>;

/// The notes of product.pulley.layout, each about an omission with a number that was built and brings the feature back.
/// Plans pick the numbers, `build` proves them. Reads `product` only.
std::vector<std::string> notes_with_advice(const formats::Product& product, const BuildOmissions& build,
                                           const RunContext& context);

/// "the nut, the home mark": features that `changed` omits and `before` has; "" if there are none.
std::string lost_features(const solid::BodyLayout& changed, const solid::BodyLayout& before);

/// "takes 52 % more motor torque and narrows the knot pockets to 1.05 mm (now 1.65)": disadvantages of a changed
/// product besides omitted features; "" without one.
std::string costs(const formats::Product& changed, const formats::Product& before);

/// ", which omits the hub and requires several turns of the pulley": what a changed product loses; "" for nothing.
std::string lost_with(const formats::Product& changed, const formats::Product& before);

}  // namespace fusee::pipeline
