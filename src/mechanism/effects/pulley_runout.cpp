#include "mechanism/effects/effect.h"

namespace fusee {

Effect pulley_runout(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "pulley_runout";
  effect.place = "pulley";
  effect.signature = "once per turn of the pulley, whichever way and load";
  effect.correctable_by = "pulley";
  effect.separating_run = "turn the pulley on its shaft by a quarter turn and repeat the slow unloaded run";
  effect.parameters = {{"x_mm", &Imperfections::runout_x, -2, 2, 2e-3, shown::as_is},
                       {"y_mm", &Imperfections::runout_y, -2, 2, 2e-3, shown::as_is}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
