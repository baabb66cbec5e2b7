/// \file
/// A part as a slicer sees it: layer upon layer. mm, rad.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// How far a layer's corner reaches when it is widened. PrusaSlicer squares it, but edges of a few µm, which a section
/// may always have, make it round: what only a squared corner holds is supported as chance has it (three blocks under
/// one of 160 parts).
enum class Corners { round, squared };

/// Places where a layer stands out over the one below by more than a face at `overhang` above the horizontal would, as
/// PrusaSlicer finds them: the part as it lies, in layers of 0.2 mm, each widened all round, from the third on. One a
/// loop of a layer, the furthest. A ceiling that is closed all round has none: it is bridged.
std::vector<Vec3> ledges_in_layers(const TriangleMesh& lying, double overhang, Corners corners);

}  // namespace fusee
