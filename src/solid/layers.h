/// \file
/// Internal: a part in layers, as a slicer processes it. mm, rad.
#pragma once

#include <vector>

#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::solid {

/// The shape of a layer's corner after widening. PrusaSlicer squares it, but edges of a few µm, which a section may
/// always have, make it round. Support by a squared corner alone is therefore unreliable (three support blocks under
/// one of 160 parts).
enum class Corners { round, squared };

/// Places where a layer projects over the one below by more than a face at `overhang` above the horizontal would.
/// Follows PrusaSlicer: layers of 0.2 mm in print orientation, each widened all round, from the third on. One place for
/// each loop of a layer, the furthest. A ceiling closed all round has none, because it is bridged.
std::vector<Vec3> ledges_in_layers(const TriangleMesh& lying, double overhang, Corners corners);

}  // namespace fusee::solid
