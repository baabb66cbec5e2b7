#include "pipeline/without_law.h"

#include "fusee/transmission.h"

namespace fusee::pipeline {

std::optional<profile::SynthesisResult> without_law(const Mechanism& mechanism) {
  if (mechanism.transmission || !transmission::Transmission(mechanism).dead_centre()) return std::nullopt;
  return profile::synthesise(mechanism);
}

}  // namespace fusee::pipeline
