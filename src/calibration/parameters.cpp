#include "calibration/parameters.h"

#include <algorithm>
#include <cmath>

namespace fusee::calibration {

bool is_searched(const fusee::Effect& effect) {
  return std::any_of(effect.parameters.begin(), effect.parameters.end(),
                     [](const EffectParameter& p) { return p.searched; });
}

const EffectParameter* free_offset(const Mechanism& declared) {
  static const EffectParameter offset{.name = "offset_deg",
                                      .number = [](Imperfections& at) -> double& { return at.sensor.zero; },
                                      .least = -100.0,
                                      .most = 100.0,
                                      .step = 1e-2,
                                      .shown = shown::in_degrees,
                                      .key = {}};
  return declared.transmission ? &offset : nullptr;
}

Parameters parameters_of(const EffectSet& effects) {
  Parameters parameters;
  for (const fusee::Effect* effect : effects) {
    for (const EffectParameter& parameter : effect->parameters) {
      if (!parameter.searched) parameters.push_back(&parameter);
    }
  }
  return parameters;
}

Parameters varied(const Mechanism& declared, const EffectSet& effects) {
  Parameters parameters = parameters_of(effects);
  if (const EffectParameter* offset = free_offset(declared)) parameters.insert(parameters.begin(), offset);
  return parameters;
}

Imperfections without(Imperfections at, const fusee::Effect& effect) {
  for (const EffectParameter& parameter : effect.parameters) reset(at, parameter);
  return at;
}

EffectSet without(const EffectSet& effects, const fusee::Effect& effect) {
  EffectSet others;
  std::copy_if(effects.begin(), effects.end(), std::back_inserter(others),
               [&](const fusee::Effect* other) { return other != &effect; });
  return others;
}

bool contains(const EffectSet& effects, const fusee::Effect& effect) {
  return std::find(effects.begin(), effects.end(), &effect) != effects.end();
}

bool at_end(const Imperfections& at, const EffectParameter& parameter) {
  const double value = value_of(at, parameter);
  return value <= parameter.least + 1e-9 * parameter.step || value >= parameter.most - 1e-9 * parameter.step;
}

bool at_bound(const Imperfections& at, const EffectParameter& parameter) {
  return at_end(at, parameter) && std::abs(value_of(at, parameter) - parameter.value_if_absent) > 1e-9 * parameter.step;
}

}  // namespace fusee::calibration
