#include "mechanism/effects/effect.h"

namespace fusee {
namespace {

double in_ppm(double value, const Mechanism&) { return 1e6 * value; }

}  // namespace

Effect thermal_expansion(const Mechanism& declared, const Measurement&) {
  Effect effect;
  effect.name = "thermal_expansion";
  effect.place = "tendon";
  effect.signature = "follows the temperature";
  effect.correctable_by = "";
  effect.separating_run = "log temperature_C over a warm-up without motion";
  effect.parameters = {{"tendon1_ppm_per_K", &Imperfections::thermal1, -5e-3, 5e-3, 2e-6, in_ppm},
                       {"tendon2_ppm_per_K", &Imperfections::thermal2, -5e-3, 5e-3, 2e-6, in_ppm}};
  if (declared.transmission)
    effect.parameters = {{"per_K_deg", &Imperfections::warmth, -0.05, 0.05, 1e-4, shown::in_degrees}};
  effect.applies = applies::with_temperature;
  return effect;
}

}  // namespace fusee
