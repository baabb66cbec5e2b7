#include "mechanism/effect.h"

namespace fusee {

Effect sensor_lag(JointKind) {
  Effect effect;
  effect.name = "sensor_lag";
  effect.place = ChainPlace::joint_sensor;
  effect.rank = 5;
  effect.signature = "hysteresis that grows with speed; it decays in time after a stop";
  effect.separating_run =
      "repeat one run at a tenth of its speed, and dwell at several angles: hysteresis by a delay vanishes";
  effect.needs = {.time = true};
  effect.parameters = {
      {.name = "lag_ms",
       .number = [](Imperfections& at) -> double& { return at.sensor.lag; },
       .least = 0,
       .most = 2,
       .step = 2e-3,
       .prior = 0.05,  // from a control period to a filtered sensor on a bus: 1 to 100 ms
       .shown = shown::in_ms,
       .key = key::plain("lag_s", "s", 0, 1000, "delay of the joint sensor")},
      {.name = "first_order",
       .number = [](Imperfections& at) -> double& { return at.sensor.first_order; },
       .least = 0,
       .most = 1,
       .step = 1,
       .shown = shown::as_is,
       .key = key::plain("lag_first_order", "", 0, 1, "1: lag_s is a filter's time constant; 0: a transport delay"),
       .searched = true}};
  // A delay and a filter of the same 50 ms differ by 0.1 to 0.2 degrees in a fast run, so that data can select between
  // them.
  effect.starts = {{0.02, 0}, {0.1, 0}, {0.5, 0}, {0.02, 1}, {0.1, 1}, {0.5, 1}};
  return effect;
}

}  // namespace fusee
