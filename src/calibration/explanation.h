/// \file
/// Results of a calibration in words: effects with their groups, rivals that the data do not distinguish, and the sizes
/// that the other effects would have been detected at.
#pragma once

#include <string>
#include <vector>

#include "calibration/selection.h"

namespace fusee {

/// In the order of selection.best.effects. `numbers`: the same set with the numbers that are handed over.
std::vector<FoundEffect> found_effects(const Evidence& evidence, const Selection& selection, const Fit& numbers);

/// With which the data are as likely as far as they can tell, and likelier than with nothing in the place of what was
/// found.
std::vector<const Rival*> rivals_as_good(const Evidence& evidence, const Selection& selection);

/// "pulley_scale (scale_percent = −2.01) or slack (slack_mm = 0.31): 0.004° rms apart in these runs", one for each
/// rival that does as well.
std::vector<std::string> null_combinations(const Evidence& evidence, const Selection& selection);

/// Of every effect that was not found: the least that these data would have shown, at the joint.
std::vector<Detectable> detectable_sizes(const Evidence& evidence, Workers& workers, const Selection& selection);

}  // namespace fusee
