/// \file
/// Which tie-offs a part's unprintable places belong to. mm.
#pragma once

#include <string>
#include <vector>

#include "fusee/solid/mesh.h"
#include "solid/body.h"
#include "solid/layers.h"
#include "solid/plan.h"

namespace fusee {

/// Places of a part that would need a support as it lies: layers that stand out too far, and what begins in mid-air;
/// where they are in the whole, without the mesh's scale.
std::vector<Vec3> unprintable_places(const TriangleMesh& lying, Piece piece, const BodyLayout& layout, double overhang,
                                     Corners corners);

constexpr const char* k_prints = "prints";  ///< a condition
/// What a part fails by that has such places; `whatever`: what was tried, "wherever its tie-offs lie".
Condition does_not_print(const std::string& name, const std::vector<Vec3>& places, const std::string& whatever);

/// The tie-off, or its tail's slot, that is nearest to each place; what is too far from all is nobody's.
std::vector<Rejection> blamed_for(const std::vector<Vec3>& places, const BodyPlan& plan);

}  // namespace fusee
