/// \file
/// Unmodelled effects in the mechanism itself, outside the catalogue: they move angles and tensions together, which a
/// curve beside the readings cannot.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "calibration/fitter_pool.h"
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

}  // namespace fusee::calibration
