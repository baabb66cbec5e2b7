#include "mechanism/effects/effect.h"

namespace fusee {

Effect zero_offset(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "zero_offset";
  effect.place = "joint sensor";
  effect.signature = "one constant";
  effect.correctable_by = "table";
  effect.separating_run = "drive the joint to a mechanical stop or mark at home and read both sensors there";
  effect.parameters = {{"offset_deg", &Imperfections::zero, -0.35, 0.35, 1e-3, shown::in_degrees}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
