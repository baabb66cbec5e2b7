/// \file
/// A joint drawn with characters: as report.html draws it, with the same letters.
#pragma once

#include <string>

#include "fusee/export.h"

namespace fusee::cli {

/// The joint at home to scale, 2 columns as wide as a line is high: link, drum, pins, pulley and tendons. Beside it
/// each letter with its place and the key of the file.
std::string joint_picture(const formats::Product& product);

}  // namespace fusee::cli
