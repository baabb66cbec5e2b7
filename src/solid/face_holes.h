/// \file
/// Internal: tie-offs of pulleys too small for a channel and a pocket. mm.
#pragma once

#include <optional>

#include "fusee/solid.h"
#include "solid/anchors.h"

namespace fusee::solid {

/// The tie-off at the first free place after the end of the active arc, with the largest countersink there up to radius
/// `wanted`. Empty if the flange is too thin, or if no place is free.
std::optional<FaceHole> find_face_hole(const AnchorSite& site, const BodyLayout& layout, bool wound_end, double wanted,
                                       const LapRange& laps);

/// Depth of a countersink. Its cone is steep enough to be printed as a ceiling.
double countersink_depth(const BodyLayout& layout, const FaceHole& hole);

}  // namespace fusee::solid
