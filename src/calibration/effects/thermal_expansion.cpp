#include "calibration/effects/effect.h"

namespace fusee {

Effect thermal_expansion(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "thermal_expansion";
  effect.place = "tendon";
  effect.signature = "follows the temperature";
  effect.correctable_by = "";
  effect.separating_run = "log temperature_C over a warm-up without motion";
  effect.parameters = {{"per_K_deg", &Imperfections::thermal, -0.05, 0.05, 1e-4, shown::in_degrees}};
  effect.applies = applies::with_temperature;
  return effect;
}

}  // namespace fusee
