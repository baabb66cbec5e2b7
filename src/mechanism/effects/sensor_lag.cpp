#include "fusee/mechanism/effect.h"

namespace fusee {

Effect sensor_lag(JointKind) {
  Effect effect;
  effect.name = "sensor_lag";
  effect.place = ChainPlace::joint_sensor;
  effect.rank = 4;
  effect.signature = "a loop that grows with speed; it decays in time after a stop";
  effect.separating_run = "repeat one run at a tenth of its speed, and dwell at a few places: a delay vanishes";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.time = true};
  effect.parameters = {{.name = "lag_ms",
                        .number = [](Imperfections& at) -> double& { return at.sensor.lag; },
                        .least = 0,
                        .most = 2,
                        .step = 2e-3,
                        .prior = 0.05,  // a control period to a filtered sensor on a bus: 1 to 100 ms
                        .shown = shown::in_ms,
                        .key = key::plain("lag_s", "s", 0, 1000, "by which the joint sensor is late")}};
  effect.starts = {{0.02}, {0.1}, {0.5}};
  return effect;
}

}  // namespace fusee
