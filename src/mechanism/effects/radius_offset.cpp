#include "mechanism/effects/effect.h"

namespace fusee {

Effect radius_offset(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "radius_offset";
  effect.place = "pulley";
  effect.signature = "smooth in alpha, no direction, no load: both pulleys too large by a constant";
  effect.correctable_by = "pulley";
  effect.separating_run = "measure the diameter of the pulley's groove floor and of the tendon with a caliper";
  effect.parameters = {{"offset_mm", &Imperfections::radius_offset, -2, 2, 2e-3, shown::as_is}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
