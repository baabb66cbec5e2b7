#include "mechanism/effects/effect.h"

namespace fusee {

Effect sensor_lag(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "sensor_lag";
  effect.place = "joint sensor";
  effect.signature = "a loop that grows with speed; it decays in time after a stop";
  effect.correctable_by = "table";
  effect.separating_run = "repeat one run at a tenth of its speed, and dwell at a few places: a delay vanishes";
  effect.parameters = {{"lag_ms", &Imperfections::lag, 0, 2, 2e-3, shown::in_ms}};
  effect.starts = {{0.02}, {0.1}, {0.5}};
  effect.applies = applies::with_speeds;
  return effect;
}

}  // namespace fusee
