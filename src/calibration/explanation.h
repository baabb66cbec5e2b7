/// \file
/// Reported effects with their groups, equally likely rivals, and detectable sizes of the other effects.
#pragma once

#include <string>
#include <vector>

#include "calibration/selection.h"

namespace fusee::calibration {

/// Found effects in the order of selection.best.effects. `numbers`: the same set with the reported parameters.
std::vector<FoundEffect> found_effects(const Evidence& evidence, const Selection& selection, const Fit& numbers);

/// Rivals that the data do not distinguish from the found effect, and that are likelier than none in its place.
std::vector<const Rival*> equally_likely_rivals(const Selection& selection);

/// "pulley_scale (scale_percent = −2.01) or slack (slack_mm = 0.31): 0.004° rms apart in these runs", one for each
/// equally likely rival.
std::vector<std::string> null_combinations(const Evidence& evidence, const Selection& selection);

/// Smallest detectable error of every effect that was not found, at the joint.
std::vector<Detectable> detectable_sizes(const Evidence& evidence, FitterPool& pool, const Selection& selection);

}  // namespace fusee::calibration
