/// \file
/// What will be built, before any triangle: sizes, anchors, and the conditions that say whether it can be. mm, not yet
/// scaled.
#pragma once

#include <vector>

#include "fusee/solid/pulley.h"
#include "solid/body.h"
#include "solid/tie_offs.h"

namespace fusee {

struct BodyPlan {
  BodyLayout layout;
  FlangeRims rims;
  Polygon floor1, floor2;  ///< of the grooves, coarse: nowhere outside them
  std::vector<PlannedAnchor> anchors;
  std::vector<Condition> conditions;

  bool possible() const;
};

/// With tie-offs as far round as there is room for, or where something else then has no place, near the active arc.
/// `wrap` nearest: these alone, which say as well whether there is any plan, in a tenth of the time.
BodyPlan plan_body(const Mechanism& mechanism, const SynthesisResult& synthesis,
                   WrapChoice wrap = WrapChoice::furthest);

}  // namespace fusee
