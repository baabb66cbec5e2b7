#include "mechanism/effects/effect.h"

namespace fusee {

Effect profile_error(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "profile_error";
  effect.place = "pulley";
  effect.signature = "twice or three times per turn of the pulley, whichever way and load";
  effect.correctable_by = "pulley";
  effect.separating_run = "turn the pulley on its shaft by an eighth of a turn and repeat the slow unloaded run";
  effect.parameters = {{"sin_mm", &Imperfections::profile_sin, -2, 2, 2e-3, shown::as_is},
                       {"cos_mm", &Imperfections::profile_cos, -2, 2, 2e-3, shown::as_is},
                       {"harmonic", &Imperfections::profile_harmonic, 2, 3, 1, shown::as_is, true}};
  effect.starts = {{0, 0, 2}, {0, 0, 3}};
  effect.applies = applies::to_full_turn;
  return effect;
}

}  // namespace fusee
