#include "mechanism/effects/effect.h"

namespace fusee {

Effect joint_sensor_gain(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "joint_sensor_gain";
  effect.place = "joint sensor";
  effect.signature = "in proportion to theta, whichever way and load";
  effect.correctable_by = "table";
  effect.separating_run = "read the joint's sensor against a square at two angles";
  effect.parameters = {{"gain_percent", &Imperfections::gain, -0.3, 0.3, 1e-3, shown::in_percent}};
  effect.applies = applies::always;
  return effect;
}

}  // namespace fusee
