/// \file
/// Internal: a mechanism file and its settings (--set) as outputs name them.
#pragma once

#include <string>

#include "base/json.h"
#include "fusee/mechanism_file.h"

namespace fusee::formats {

/// A key's value in the file's unit. JSON has no NaN and no infinity: they become null.
Json field_value(const Field& field, const DeclaredMechanism& mechanism);

/// {"file", "sha256", "set": {key: value}}. The name has no folder: the same input gives the same bytes in any place.
Json input_json(const MechanismFile& file);

/// HTML: the file's name without its folder, and the settings as on the command line. The last value of a key counts.
std::string source_html(const MechanismFile& file);

}  // namespace fusee::formats
