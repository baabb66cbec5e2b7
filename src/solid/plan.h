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
BodyPlan plan_body(const Mechanism& mechanism, const SynthesisResult& synthesis, const TieOffWishes& wishes = {});

}  // namespace fusee
