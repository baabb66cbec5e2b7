#include "cli/pins.h"

#include "base/text.h"

namespace fusee::cli {

std::string pins_text(const Mechanism& mechanism) {
  return mechanism.has_point_pins() ? "points (the paper's equations)" : "cylinders, and tendons with thickness";
}

Json pins_json(const Mechanism& mechanism) {
  return {{"points", mechanism.has_point_pins()}, {"pitch_radius_mm", mechanism.seen_pitch_radius()}};
}

void add_pins_note(const MechanismFile& file, Reply& reply) {
  const Mechanism& mechanism = file.mechanism;
  if (!mechanism.has_point_pins() && mechanism.guides.radius > 0) return;
  reply.diagnostics.push_back(about_file(Severity::note, file.path,
                                         std::string("pins are modelled ") + (mechanism.has_point_pins() ? "as " : "") +
                                             pins_text(mechanism) + ": the tendon's centre line runs " +
                                             rounded(mechanism.seen_pitch_radius()) + " mm from a pin's centre"));
}

}  // namespace fusee::cli
