/// \file
/// Which effects the data ask for, which would do as well, and what they would have shown of the others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration/fit.h"
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
  std::vector<const Effect*> catalogue;
  Fit none;                   ///< the declared model
  Fit best;                   ///< with all accepted effects
  std::vector<Rival> rivals;  ///< of every accepted effect, usable ones
  std::vector<Candidate> tried;
};

/// Mean square error that counts as noise, rad².
double noise_limit(double floor);

/// Whether strokes of one run and direction differ by more than noise lets them.
bool is_walking(const StrokeScatter& scatter);

/// Whether two held-out errors are the same as far as the data can tell: within a standard error, or within a small
/// part of the noise.
bool as_good(const Evidence& evidence, const Fit& rival, const Fit& best);

/// An empty catalogue's answer with an unusable `none` where the declared joint has no equilibrium.
Selection select_effects(const Evidence& evidence, Workers& workers,
                         const std::function<void(const std::string&, double)>& progress);

}  // namespace fusee
