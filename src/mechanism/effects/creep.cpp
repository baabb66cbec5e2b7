#include "mechanism/effects/effect.h"

namespace fusee {

Effect creep(const Mechanism& declared, const Measurement&) {
  Effect effect;
  effect.name = "creep";
  effect.place = "tendon";
  effect.signature = "grows with the logarithm of time at constant load";
  effect.correctable_by = "table";
  effect.separating_run = "hold one loaded position for ten minutes and log it";
  effect.parameters = {{"compliance_percent_per_decade", &Imperfections::creep, 0, 10, 2e-3, shown::in_percent}};
  if (declared.transmission)
    effect.parameters = {{"per_decade_deg_per_load", &Imperfections::drift, -1e6, 1e6, 1e-4, shown::in_degrees}};
  effect.applies = applies::with_time_and_load;
  return effect;
}

}  // namespace fusee
