/// \file
/// Internal: support attribution, which assigns a part's unprintable places to its tie-offs. mm.
#pragma once

#include <string>
#include <vector>

#include "fusee/solid.h"
#include "solid/body.h"
#include "solid/layers.h"
#include "solid/plan.h"

namespace fusee::solid {

/// Places of a part that would need supports in its print orientation: layers that project too far, and unsupported
/// regions. Coordinates are those of the whole part, without the mesh's scale.
std::vector<Vec3> unprintable_places(const TriangleMesh& mesh, Piece piece, const BodyLayout& layout, double overhang,
                                     Corners corners);

constexpr const char* k_prints = "prints";  ///< name of the condition
/// The condition that a part with unprintable places fails. `variants`: those that were tried, such as "for any
/// position of its tie-offs".
profile::Condition does_not_print(const std::string& name, const std::vector<Vec3>& places,
                                  const std::string& variants);

/// Attributes each place to the nearest tie-off, or to its tail's slot. Places far from all of them are attributed to
/// none.
std::vector<Rejection> attribute_supports(const std::vector<Vec3>& places, const BodyPlan& plan);

}  // namespace fusee::solid
