/// \file
/// Internal: designs curves and body of a mechanism, for the final part or, faster, for trial mechanisms of the advice.
#pragma once

#include <functional>
#include <vector>

#include "fusee/base.h"
#include "fusee/export.h"
#include "fusee/solid.h"

namespace fusee::pipeline {

/// Designs curves within `chord_error_mm` and the body of product.joint. False if it is infeasible: the reasons are
/// conditions of product.synthesis, or of product.pulley if the curves exist.
bool design(formats::Product& product, double chord_error_mm, const RunContext& context,
            solid::TieOffSearch search = solid::TieOffSearch::thorough);

/// Replaces the declared mechanism by a trial mechanism, and keeps the identified effects.
MechanismFile with_declared(MechanismFile file, const Mechanism& changed);

/// A trial mechanism: its identified joint, and its curves or the obstacles to them.
struct Curves {
  joint::IdentifiedJoint joint;
  profile::SynthesisResult synthesis;
  std::vector<profile::Condition> obstacles;
};

/// Designs coarse curves for a trial.
Curves curves_of(const DeclaredMechanism& declared);

/// A condition that fails if `wind` throws because no tendon can be wound on the curves. It applies to curves of the
/// paper's equations, which are inaccurate for large pins or thick tendons. Exact curves can always be wound: it is
/// empty for them.
std::vector<profile::Condition> winding_conditions(const Mechanism& mechanism, const std::function<void()>& wind);

}  // namespace fusee::pipeline
