/// \file
/// What acts within the joint as an effect does and stands in no catalogue: it moves angles and tensions together,
/// which no curve beside the readings does.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "calibration/selection.h"
#include "calibration/workers.h"

namespace fusee {

/// The best set with one of them in an effect's place, and in that of others that it then does as well without.
struct UnnamedInPlace {
  double score = -std::numeric_limits<double>::infinity();  ///< as it stands: not asked, or not to be had
  std::string words;
  std::string separating_run;
};

/// Of each effect that is asked for, in the order of `Selection::best`. An unnamed effect is tried where what the
/// effect does is of its kind. Of the starts of a fit none is taken after one that is above `enough`.
std::vector<UnnamedInPlace> unnamed_in_place(const Evidence& evidence, Workers& workers, const Selection& selection,
                                             const std::vector<bool>& asked, double enough);

}  // namespace fusee
