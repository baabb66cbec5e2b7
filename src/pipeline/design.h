/// \file
/// Internal: a mechanism's curves and body, as they will be made, or quickly while it is tried what would make it
/// possible.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "fusee/export/product.h"
#include "fusee/solid/pulley.h"

namespace fusee {

/// Curves and body of product.joint, with curves within `tolerance`, mm. False when no such pulley can be made: the
/// conditions of product.synthesis, or of product.pulley where there are curves, say why.
bool design(Product& product, double tolerance, const std::function<void(std::string_view step)>& before_step,
            TieOffSearch search = TieOffSearch::thorough);

/// What is tried stands in place of what was declared; what was found to be otherwise stays.
MechanismFile with_declared(MechanismFile file, const Mechanism& changed);

/// Of a mechanism that is tried: the joint as it is, and its curves or why there are none.
struct Curves {
  JointAsItIs joint;
  SynthesisResult synthesis;
  std::vector<Condition> obstacles;
};

Curves curves_of(const DeclaredMechanism& declared);

/// What the paper's equations draw may be so far from what large pins or thick tendons need that no tendon can be wound
/// on it at all: `wind` throws. What the exact method draws always can: there it would be a bug.
std::vector<Condition> windable(const Mechanism& mechanism, const std::function<void()>& wind);

}  // namespace fusee
