#include "mechanism/effects/effect.h"

namespace fusee {

Effect gravity(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "gravity";
  effect.place = "joint";
  effect.signature = "a load that turns with the joint: it acts through the tendons' stretch";
  effect.correctable_by = "pulley";
  effect.separating_run = "repeat one run with the joint lying on its side";
  effect.parameters = {{"cos_Nmm", &Imperfections::gravity_cos, -1e6, 1e6, 1, shown::as_is},
                       {"sin_Nmm", &Imperfections::gravity_sin, -1e6, 1e6, 1, shown::as_is}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
