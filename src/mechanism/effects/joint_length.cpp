#include "mechanism/effects/effect.h"

namespace fusee {
namespace {

double total(double added, const Mechanism& declared) { return declared.joint.R + added; }

}  // namespace

Effect joint_length(const Mechanism&, const Measurement&) {
  Effect effect;
  effect.name = "joint_length";
  effect.place = "joint";
  effect.signature = "smooth in theta, no direction; a load turns the joint further in proportion";
  effect.correctable_by = "pulley";
  effect.separating_run = "measure from the joint's axis to the tendons' attachment with a caliper";
  effect.parameters = {{"length_mm", &Imperfections::joint_length, -50, 50, 1e-2, total}};
  effect.applies = applies::to_tendons;
  return effect;
}

}  // namespace fusee
