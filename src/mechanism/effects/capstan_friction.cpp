#include "mechanism/effects/effect.h"

namespace fusee {
namespace {

double total(double added, const Mechanism& declared) {
  return declared.guides.mu + added > 0 ? declared.guides.mu + added : 0.0;
}

}  // namespace

Effect capstan_friction(const Mechanism& declared, const Measurement&) {
  Effect effect;
  effect.name = "capstan_friction";
  effect.place = "pins";
  effect.signature = "a loop that grows with load and wrap, with a transition after each reversal";
  effect.correctable_by = "table";
  effect.separating_run = "run at two loads: friction's loop grows with the load, backlash's does not";
  effect.parameters = {{"mu", &Imperfections::friction, -1, 2, 5e-3, total}};
  effect.starts = {{0.1}, {0.4}};
  if (declared.transmission) {
    effect.parameters = {{"half_loop_deg_per_load", &Imperfections::dry_friction, 0, 1e6, 1e-3, shown::in_degrees}};
    effect.starts.clear();
  }
  effect.applies = applies::to_tendons_or_load;
  return effect;
}

}  // namespace fusee
