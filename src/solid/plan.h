/// \file
/// Internal: the plan of a body before meshing: sizes, anchors, and the conditions for building it. mm, not yet scaled.
#pragma once

#include <vector>

#include "fusee/solid.h"
#include "solid/body.h"
#include "solid/tie_offs.h"

namespace fusee::solid {

struct BodyPlan {
  BodyLayout layout;
  FlangeRims rims;
  Polygon floor1, floor2;  ///< floors of the grooves, with few points, everywhere inside the true ones
  std::vector<PlannedAnchor> anchors;
  std::vector<Mark> marks;
  std::vector<profile::Condition> conditions;

  bool is_possible() const;
};

/// Chooses sizes and places of all features. The hub is the largest one that leaves space for every other feature, or
/// for most of them. The tie-offs lie as far round the closing arc as there is space. If another feature then has no
/// place, they lie near the active arc.
BodyPlan plan_body(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                   const TieOffWishes& wishes = {});

}  // namespace fusee::solid
