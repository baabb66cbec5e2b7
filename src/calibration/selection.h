/// \file
/// Which effects the data ask for, which would do as well, and what they would have shown of the others.
#pragma once

#include <string>
#include <vector>

#include "calibration/statistics.h"
#include "calibration/workers.h"
#include "fusee/calibration/calibration.h"

namespace fusee {

/// Another effect in the place of an accepted one.
struct Rival {
  const Effect* accepted = nullptr;
  const Effect* rival = nullptr;
  Fit fit;
};

struct Selection {
  EffectSet catalogue;        ///< what was tried
  Fit none;                   ///< the declared model
  Fit best;                   ///< with all accepted effects
  std::vector<Fit> without;   ///< `best` without each of its effects, in their order
  std::vector<Rival> rivals;  ///< of every accepted effect, usable ones
  std::vector<Candidate> tried;
};

/// What a name costs, nats.
double cost_of(const Effect& effect);

/// Evidence of a set against the others: that of the data, less what every name costs.
double score(const Fit& fit);

/// An empty catalogue's answer with an unusable `none` where the declared joint has no equilibrium.
Selection select_effects(const Evidence& evidence, Workers& workers, const CalibrationOptions& options);

}  // namespace fusee
