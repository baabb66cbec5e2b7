/// \file
/// Refits with an effect outside the catalogue, or with loads of another size, in the place of an effect.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "calibration/fit.h"
#include "calibration/selection.h"

namespace fusee::calibration {

/// Best set with an unmodelled effect in an effect's place, and without others that it makes unnecessary.
struct UnmodelledSubstitute {
  double score = -std::numeric_limits<double>::infinity();  ///< initial value: not tested, or no solution
  std::string words;
  std::string separating_run;
};

/// Result for each effect of `Selection::best`, those tested that `asked` selects. An unmodelled effect is fitted if
/// the effect's contribution is of its kind. Of the starts of a fit none is used after one that exceeds `enough`.
std::vector<UnmodelledSubstitute> fit_unmodelled_effects(const Evidence& evidence, FitterPool& pool,
                                                         const Selection& selection, const std::vector<bool>& asked,
                                                         double enough);

/// Best set without an effect, on runs with all loads scaled by one factor, as by a cell out of calibration or a lever of
/// another length. No effect describes them, since they are an error of the log.
struct LoadScaleFit {
  double times = 1;
  double score = 0;  ///< with the penalty of one searched number; −infinity: no solution, or the effect is equivalent
};

/// Result for every accepted effect, in their order.
std::vector<LoadScaleFit> fit_load_scales(const Evidence& evidence, FitterPool& pool, const Selection& selection);

}  // namespace fusee::calibration
