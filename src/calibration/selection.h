/// \file
/// Selection of the effects that the data require, and of their rivals.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/fit.h"
#include "calibration/posterior.h"
#include "calibration/statistics.h"
#include "fusee/calibration.h"

namespace fusee::calibration {

/// Fit with another effect in the place of an accepted one.
struct Rival {
  const fusee::Effect* accepted = nullptr;
  const fusee::Effect* rival = nullptr;
  Fit fit;
};

struct Selection {
  EffectSet catalogue;                ///< effects that were tested
  Fit none;                           ///< fit of the declared model
  Fit best;                           ///< fit of all accepted effects
  std::vector<Fit> without;           ///< `best` without each of its effects, the others refitted, in their order
  std::vector<Rival> rivals;          ///< usable rivals of every accepted effect
  std::vector<CredibleGroup> groups;  ///< credible group of each accepted effect, in their order
  /// Factor by which evidence is overstated: log odds are divided by it. It weighs sets; within a set it does not widen
  /// intervals.
  double temperature = 1;
  /// Mean square deviation of a number from its value in `best`, in its steps².
  struct Variance {
    double if_only = 0;  ///< if the effects of `best` are the only ones
    double overall = 0;  ///< over all sets that contain it, by their weight
  };
  std::map<const EffectParameter*, Variance> variance;
  std::vector<Candidate> tried;
};

/// Negative log prior odds of an effect, nats.
double neg_log_prior_odds(const fusee::Effect& effect);
double neg_log_prior_odds(const EffectSet& effects);
/// Penalty of a reported effect, nats.
double reporting_penalty(const fusee::Effect& effect);

/// Log posterior of a set up to a constant: log evidence, and log prior odds of effects and discrepancy.
double score(const Fit& fit);

/// Searches the catalogue. The result has an unusable `none` if the declared joint has no equilibrium.
Selection select_effects(const Evidence& evidence, FitterPool& pool, const CalibrationOptions& options);

}  // namespace fusee::calibration
