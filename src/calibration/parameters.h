/// \file
/// Parameters of a fit, and their places in the imperfections of a joint.
#pragma once

#include <vector>

#include "calibration/evidence.h"
#include "mechanism/effect.h"

namespace fusee::calibration {

using EffectSet = std::vector<const fusee::Effect*>;

/// Parameters in the order of a fit's x.
using Parameters = std::vector<const EffectParameter*>;

/// True if a parameter is searched for (an order, a time): slopes at its start predict little.
bool is_searched(const fusee::Effect& effect);

/// The free offset of a joint declared as θ = offset + α/ratio; null for any other joint.
const EffectParameter* free_offset(const Mechanism& declared);
/// Fitted parameters of these effects.
Parameters parameters_of(const EffectSet& effects);
/// The free offset, if any, then the fitted parameters.
Parameters varied(const Mechanism& declared, const EffectSet& effects);

/// `at` without an effect.
Imperfections without(Imperfections at, const fusee::Effect& effect);
EffectSet without(const EffectSet& effects, const fusee::Effect& effect);
bool contains(const EffectSet& effects, const fusee::Effect& effect);

/// True at either end of the parameter's range.
bool at_end(const Imperfections& at, const EffectParameter& parameter);
/// True at an end at which the data require more than any joint has; false if the effect is absent there.
bool at_bound(const Imperfections& at, const EffectParameter& parameter);

}  // namespace fusee::calibration
