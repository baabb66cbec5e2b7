#include "mechanism/effects/effect.h"

namespace fusee {

Effect tendon_slip(const Mechanism& declared, const Measurement&) {
  Effect effect;
  effect.name = "tendon_slip";
  effect.place = "tendon";
  effect.signature = "one step in time, at high tension, that stays";
  effect.correctable_by = "";
  effect.separating_run = "mark the tendon where it enters the pulley and look again after a loaded run";
  // Released tendon 1 lets the joint go up, released tendon 2 down.
  effect.parameters = {{"released_mm", &Imperfections::slip, -20, 20, 1e-2, shown::as_is},
                       {"time_s", &Imperfections::slip_time, -1e12, 1e12, 1, shown::as_is, true}};
  if (declared.transmission)
    effect.parameters.front() = {"step_deg", &Imperfections::step, -0.5, 0.5, 1e-3, shown::in_degrees};
  effect.starts_in_time = true;
  effect.applies = applies::with_time;
  return effect;
}

}  // namespace fusee
