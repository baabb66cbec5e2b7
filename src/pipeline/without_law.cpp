#include "pipeline/without_law.h"

#include "fusee/transmission.h"

namespace fusee {

std::optional<SynthesisResult> without_law(const Mechanism& mechanism) {
  if (mechanism.transmission || !Transmission(mechanism).dead_centre()) return std::nullopt;
  return synthesise(mechanism);
}

}  // namespace fusee
