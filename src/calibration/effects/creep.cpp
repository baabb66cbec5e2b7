#include "calibration/effects/effect.h"

namespace fusee {

Effect creep(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "creep";
  effect.place = "tendon";
  effect.signature = "grows with the logarithm of time at constant load";
  effect.correctable_by = "table";
  effect.separating_run = "hold one loaded position for ten minutes and log it";
  effect.parameters = {{"per_decade_deg", &Imperfections::creep, -1, 1, 1e-4, shown::in_degrees}};
  effect.applies = applies::with_time;
  return effect;
}

}  // namespace fusee
