#include "mechanism/effects/effect.h"

namespace fusee {
namespace {

double section(double stretch, const Mechanism& declared) {
  const double d = declared.tendon.diameter;
  return declared.tendon.modulus * 0.25 * k_pi * d * d / (1.0 + stretch);
}

}  // namespace

Effect tendon_stretch(const Mechanism& declared, const Measurement&) {
  Effect effect;
  effect.name = "tendon_stretch";
  effect.place = "tendon";
  effect.signature = "in proportion to the load, zero without; the same both ways";
  effect.correctable_by = "pulley";
  effect.separating_run = "run the same strokes at no load, at half and at full load, and at the reversed load";
  effect.parameters = {{"EA_N", &Imperfections::stretch, -0.9, 60, 0.01, section}};
  effect.starts = {{0.5}, {2.0}, {10.0}};
  if (declared.transmission) {
    effect.correctable_by = "table";
    effect.parameters = {{"compliance_deg_per_load", &Imperfections::compliance, -1e6, 1e6, 1e-3, shown::in_degrees}};
    effect.starts.clear();
  }
  effect.applies = applies::with_load;
  return effect;
}

}  // namespace fusee
