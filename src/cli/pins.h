/// \file
/// Description of the guide pins in a mechanism, common to all commands.
#pragma once

#include "cli/reply.h"
#include "fusee/mechanism_file.h"

namespace fusee::cli {

std::string pins_text(const Mechanism& mechanism);
Json pins_json(const Mechanism& mechanism);
/// Adds a note in cases that users may misread: point pins, and pins of radius 0 that are not points.
void add_pins_note(const MechanismFile& file, Reply& reply);

}  // namespace fusee::cli
