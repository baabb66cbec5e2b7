#include "mechanism/effects/effect.h"

namespace fusee {

Effect guide_position(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "guide_position";
  effect.place = "pins";
  effect.signature = "smooth in theta, no direction, no load";
  effect.correctable_by = "pulley";
  effect.separating_run = "measure the pins' distance from each other and from the joint's axis with a caliper";
  effect.parameters = {{"outward_mm", &Imperfections::guide_outward, -20, 20, 1e-2, shown::as_is},
                       {"down_mm", &Imperfections::guide_down, -20, 20, 1e-2, shown::as_is}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
