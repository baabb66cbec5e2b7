#include "mechanism/effects/effect.h"

namespace fusee {

Effect pulley_scale(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "pulley_scale";
  effect.place = "pulley";
  effect.signature = "smooth in alpha, no direction, no load: both pulleys too large in proportion";
  effect.correctable_by = "pulley";
  effect.separating_run = "measure two diameters of the printed part with a caliper";
  effect.parameters = {{"scale_percent", &Imperfections::pulley_scale, -0.15, 0.15, 2e-4, shown::in_percent}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
