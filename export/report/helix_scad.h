/// \file
/// Internal: pulley.scad of a multi-turn pulley.
#pragma once

#include <string>

#include "fusee/export.h"

namespace fusee::formats {

std::string helix_scad(const Product& product);

}  // namespace fusee::formats
