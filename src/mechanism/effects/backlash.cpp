#include "mechanism/effects/effect.h"

namespace fusee {

Effect backlash(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "backlash";
  effect.place = "shaft";
  effect.signature =
      "a square loop of constant width in alpha, whatever load and speed; it decays over distance after a reversal";
  effect.correctable_by = "table";
  effect.separating_run =
      "repeat one run at a tenth of its speed and one at another load: backlash changes with neither";
  effect.parameters = {{"width_deg", &Imperfections::backlash, 0, 0.5, 2e-3, shown::in_degrees}};
  effect.starts = {{radians(0.3)}, {radians(1.5)}, {radians(5.0)}};
  effect.applies = applies::always;
  return effect;
}

}  // namespace fusee
