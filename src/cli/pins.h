/// \file
/// How a mechanism's guide pins are seen, the same words for every command.
#pragma once

#include "cli/reply.h"
#include "fusee/mechanism/file.h"

namespace fusee::cli {

std::string pins_text(const Mechanism& mechanism);
Json pins_json(const Mechanism& mechanism);
/// A note where a person may think otherwise: pins that are points, and pins of radius 0 that are none.
void add_pins_note(const MechanismFile& file, Reply& reply);

}  // namespace fusee::cli
