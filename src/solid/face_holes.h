/// \file
/// Tie-offs of pulleys too small for a channel and a pocket. mm.
#pragma once

#include <optional>

#include "fusee/solid/layout.h"
#include "solid/anchors.h"

namespace fusee {

/// The first place from the end of the active arc on, with the largest countersink up to `wanted`; null where the
/// flange is too narrow or too thin, or nothing is free.
std::optional<FaceHole> find_face_hole(const AnchorSite& site, const BodyLayout& layout, bool wound_end, double wanted,
                                       const LapRange& laps);

/// Depth of a countersink: it narrows to the hole as steeply as a roof must be.
double countersink_depth(const BodyLayout& layout, const FaceHole& hole);

}  // namespace fusee
