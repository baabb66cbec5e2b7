#include "pipeline/without_law.h"

#include "fusee/pipeline.h"
#include "fusee/transmission.h"

namespace fusee::pipeline {

void demand_tendons(const MechanismFile& file, const std::string& verb) {
  if (!file.mechanism.transmission) return;
  throw InputError(file.path, "a joint with [transmission] has no tendons to " + verb,
                   "[transmission] is for 'fusee calibrate'");
}

std::optional<profile::SynthesisResult> without_law(const Mechanism& mechanism) {
  if (mechanism.transmission || !transmission::Transmission(mechanism).dead_centre()) return std::nullopt;
  return profile::synthesise(mechanism);
}

}  // namespace fusee::pipeline
