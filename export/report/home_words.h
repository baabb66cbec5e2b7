/// \file
/// Internal: how a person recognises the home position of a pulley.
#pragma once

#include <string>

#include "fusee/export.h"

namespace fusee::formats {

/// "the home mark pointing to +y", or the place of tendon 2's knot pocket where the part has no home mark.
std::string home_words(const Product& product);

}  // namespace fusee::formats
