/// \file
/// Description of the guide pins in a mechanism, common to all commands.
#pragma once

#include "cli/reply.h"
#include "fusee/mechanism_file.h"

namespace fusee::cli {

std::string pins_text(const Mechanism& mechanism);
Json pins_json(const Mechanism& mechanism);
/// Adds a note where users may misread the model: pins as points, or pins of radius 0 that keep the tendon's radius.
void add_pins_note(const MechanismFile& file, Reply& reply);

}  // namespace fusee::cli
