#include "mechanism/effects/effect.h"

namespace fusee {

Effect motor_offset(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "motor_offset";
  effect.place = "motor sensor";
  effect.signature = "like a zero offset of the joint, in proportion to the transmission's slope";
  effect.correctable_by = "table";
  effect.separating_run = "drive the joint to a mechanical stop or mark at home and read both sensors there";
  effect.parameters = {{"offset_deg", &Imperfections::motor_offset, -0.35, 0.35, 1e-3, shown::in_degrees}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
