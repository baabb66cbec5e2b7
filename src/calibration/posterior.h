/// \file
/// Posterior over sets of effects: credible groups, of which one member is present (credible sets of Wang et al. 2020
/// for correlated causes).
#pragma once

#include <vector>

#include "calibration/parameters.h"

namespace fusee::calibration {

/// True if the sets have a common effect.
bool shares(const EffectSet& one, const EffectSet& other);

/// Visited set of effects, weighted by its posterior probability up to a constant.
struct WeightedSet {
  EffectSet effects;
  double log_weight = 0;
};

/// Effects of which at least one is present, with posterior probability 1 − `absence_probability`.
struct CredibleGroup {
  EffectSet members;  ///< members, the reported effect first
  double absence_probability = 0;
  EffectSet companions = {};  ///< effects that may be present beside a member, but are no alternatives to it
};

/// Group of the effect `named` of the set `best`: alternatives, which other sets have in its place, are added until
/// the absence probability is at most `most_absence`, or until no alternative is left. `least_gain`: share of the
/// absence probability that each further member must remove.
CredibleGroup credible_group(const std::vector<WeightedSet>& sets, const EffectSet& best, const fusee::Effect& named,
                             double most_absence, double least_gain = 0);

}  // namespace fusee::calibration
