/// \file
/// The numbers that a fit varies, and where they stand in the imperfections of a joint.
#pragma once

#include <vector>

#include "calibration/evidence.h"
#include "fusee/mechanism/effect.h"

namespace fusee {

using EffectSet = std::vector<const Effect*>;

/// In the order of a fit's x.
using Parameters = std::vector<const EffectParameter*>;

/// Whether where it acts has to be found: a look from where it begins says little of it.
bool is_searched(const Effect& effect);

/// θ = offset + α/ratio declares its offset free; null of any other joint.
const EffectParameter* free_offset(const Mechanism& declared);
/// The fitted numbers of these effects.
Parameters parameters_of(const EffectSet& effects);
/// The fitted numbers behind the free offset.
Parameters varied(const Mechanism& declared, const EffectSet& effects);

/// `at` without an effect.
Imperfections without(Imperfections at, const Effect& effect);
EffectSet without(const EffectSet& effects, const Effect& effect);
bool contains(const EffectSet& effects, const Effect& effect);

/// True at either end of the number's range.
bool at_end(const Imperfections& at, const EffectParameter& parameter);
/// True at an end where the data ask for more than any joint has; false where the joint has none of the effect.
bool at_bound(const Imperfections& at, const EffectParameter& parameter);

}  // namespace fusee
