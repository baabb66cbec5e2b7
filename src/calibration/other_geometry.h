/// \file
/// Geometry that is not as declared and has no name: paths that are longer, or shorter, by a smooth curve of the
/// joint's angle. It moves the joint without a load, and its moment arms with it.
#pragma once

#include <vector>

#include "calibration/selection.h"
#include "calibration/workers.h"

namespace fusee {

/// Score of the best set with such paths in an effect's place and in that of others that it then does as well without,
/// of each that is asked for, in the order of `Selection::best`; −infinity: not asked, nothing that geometry does, or
/// not to be had. Of the starts of a fit none is taken after one that is above `enough`.
std::vector<double> under_other_geometry(const Evidence& evidence, Workers& workers, const Selection& selection,
                                         const std::vector<bool>& asked, double enough);

}  // namespace fusee
