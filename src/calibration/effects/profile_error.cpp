#include "calibration/effects/effect.h"

namespace fusee {

Effect profile_error(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "profile_error";
  effect.place = "pulley";
  effect.signature = "twice per turn of the pulley, whichever way and load";
  effect.correctable_by = "pulley";
  effect.separating_run = "turn the pulley on its shaft by an eighth of a turn and repeat the slow unloaded run";
  effect.parameters = {{"sin_deg", &Imperfections::profile_sin, -0.2, 0.2, 1e-3, shown::in_degrees},
                      {"cos_deg", &Imperfections::profile_cos, -0.2, 0.2, 1e-3, shown::in_degrees}};
  effect.applies = applies::to_full_turn;
  return effect;
}

}  // namespace fusee
