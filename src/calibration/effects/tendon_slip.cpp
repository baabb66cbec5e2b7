#include "calibration/effects/effect.h"

namespace fusee {

Effect tendon_slip(const Mechanism&, const Measurement& measurement) {
  Effect effect;
  effect.name = "tendon_slip";
  effect.place = "tendon";
  effect.signature = "one step in time, at high tension, that stays";
  effect.correctable_by = "";
  effect.separating_run = "mark the tendon where it enters the pulley and look again after a loaded run";
  effect.parameters = {{"step_deg", &Imperfections::slip, -0.5, 0.5, 1e-3, shown::in_degrees},
                      {"time_s", &Imperfections::slip_time, -1e12, 1e12, 1, shown::as_is, true}};
  // Wherever a stroke begins and in its middle: where a tendon slips, it does so under load and on the move.
  for (const Run& run : measurement.runs) {
    for (const Stroke& stroke : run.strokes) {
      effect.starts.push_back({0, run.samples[stroke.first].time});
      effect.starts.push_back({0, run.samples[(stroke.first + stroke.last) / 2].time});
    }
  }
  effect.applies = applies::with_time;
  return effect;
}

}  // namespace fusee
