/// \file
/// Which effects the data ask for, which would do as well, and what they would have shown of the others.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/posterior.h"
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
  EffectSet catalogue;                ///< what was tried
  Fit none;                           ///< the declared model
  Fit best;                           ///< with all accepted effects
  std::vector<Fit> without;           ///< `best` without each of its effects, in their order
  std::vector<Rival> rivals;          ///< of every accepted effect, usable ones
  std::vector<CredibleGroup> groups;  ///< of every accepted effect, in their order
  double temperature = 1;             ///< by which evidence is overstated: variances are as many times larger
  /// Mean square of a number about its value in `best`, in its steps.
  struct Variance {
    double if_only = 0;  ///< with the effects of `best` and no other
    double overall = 0;  ///< over all sets that hold it by their weight, and with whatever may be there beside it
  };
  std::map<const EffectParameter*, Variance> variance;
  std::vector<Candidate> tried;
};

/// By how much an effect is rarer than none, nats.
double rareness_of(const Effect& effect);
double rareness_of(const EffectSet& effects);
/// What a name costs, nats.
double cost_of(const Effect& effect);

/// Log of how likely a set is, but for a constant: by the data, and by how common faults are.
double score(const Fit& fit);

/// An empty catalogue's answer with an unusable `none` where the declared joint has no equilibrium.
Selection select_effects(const Evidence& evidence, Workers& workers, const CalibrationOptions& options);

}  // namespace fusee
