/// \file
/// How sure the data are of an effect, over all sets of effects that were looked at: groups of which one is there
/// (credible sets, as Wang et al. 2020 have them for correlated causes).
#pragma once

#include <vector>

#include "calibration/parameters.h"

namespace fusee {

/// Whether an effect of the one is in the other.
bool shares(const EffectSet& one, const EffectSet& other);

/// A set that was looked at; of two the one with the larger weight is the likelier.
struct Weighed {
  EffectSet effects;
  double log_weight = 0;
};

/// Effects of which one at least is there, as surely as 1 − `doubt`.
struct CredibleGroup {
  EffectSet members;  ///< what was named first
  double doubt = 0;
};

/// `named` of the set `best`, with as many others that stand in its place as it takes to be sure to within
/// `most_doubt`; where what speaks against it has nothing in its place the doubt stays larger. `least_gain`: each other
/// takes more than this part of the doubt away.
CredibleGroup credible_group(const std::vector<Weighed>& sets, const EffectSet& best, const Effect& named,
                             double most_doubt, double least_gain = 0);

}  // namespace fusee
