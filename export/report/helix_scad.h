/// \file
/// pulley.scad of a pulley of several turns.
#pragma once

#include <string>

#include "fusee/export/product.h"

namespace fusee {

std::string helix_scad(const Product& product);

}  // namespace fusee
