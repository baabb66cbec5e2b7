/// \file
/// A joint drawn with characters: as report.html draws it, with the same letters.
#pragma once

#include <string>

#include "fusee/export.h"

namespace fusee::cli {

/// The joint at home, to scale if two columns are as wide as a line is high: link, drum, pins, pulley and tendons.
/// Beside it the meaning of each letter, and its place.
std::string joint_picture(const formats::Product& product);

}  // namespace fusee::cli
