#include "mechanism/effects/effect.h"

namespace fusee {
namespace {

double total(double added, const Mechanism& declared) {
  return declared.guides.radius + added > 0 ? declared.guides.radius + added : 0.0;
}

}  // namespace

Effect guide_radius(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "guide_radius";
  effect.place = "pins";
  effect.signature = "smooth in theta, no direction; grows towards both ends of the range";
  effect.correctable_by = "pulley";
  effect.separating_run = "measure the guide pins with a caliper";
  effect.parameters = {{"radius_mm", &Imperfections::guide_radius, -20, 20, 5e-3, total}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
