/// \file
/// The numbers that a fit varies, and where they stand in the imperfections of a joint.
#pragma once

#include <memory>
#include <vector>

#include "calibration/evidence.h"
#include "mechanism/effects/effect.h"

namespace fusee {

using EffectSet = std::vector<const Effect*>;

/// The effects that a joint can have and data can show. Fits name them by address: a copy shares them.
class Catalogue {
 public:
  Catalogue() = default;
  Catalogue(const Mechanism& declared, const Measurement& measurement)
      : effects_(std::make_shared<const std::vector<Effect>>(catalogue(declared, measurement))) {}

  EffectSet all() const;

 private:
  std::shared_ptr<const std::vector<Effect>> effects_;
};

/// In the order of a fit's x.
using Parameters = std::vector<const EffectParameter*>;

inline double value_of(const Imperfections& at, const EffectParameter& parameter) { return at.*parameter.member; }
inline void set_value(Imperfections& at, const EffectParameter& parameter, double value) {
  at.*parameter.member = value;
}
inline double value_of(const Imperfections& at, const HandReading& reading) { return at.*reading.member; }
/// Whether the reading is of this number.
inline bool is_read_by(const EffectParameter& parameter, const HandReading& reading) {
  return parameter.member == reading.member;
}

/// θ = offset + α/ratio declares its offset free; null of any other joint.
const EffectParameter* free_offset(const Mechanism& declared);
/// What is fitted of these effects, behind the free offset.
Parameters varied(const Mechanism& declared, const EffectSet& effects);

/// `at` without an effect.
Imperfections without(Imperfections at, const Effect& effect);
EffectSet without(const EffectSet& effects, const Effect& effect);
bool contains(const EffectSet& effects, const Effect& effect);

bool at_bound(const Imperfections& at, const EffectParameter& parameter);

}  // namespace fusee
