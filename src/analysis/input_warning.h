/// \file
/// Internal: likely input errors, before they are assigned a place in a file.
#pragma once

#include <string>
#include <vector>

#include "fusee/mechanism.h"

namespace fusee::analysis {

/// A likely input error of one key.
struct InputWarning {
  std::string key;      ///< key at which the warning is reported
  std::string message;  ///< the oddity, with the value and its unit
  std::string hint;     ///< the likely intention
};

/// The number of the key in the file's unit.
double declared_number(const DeclaredMechanism& mechanism, const char* key);
/// "pulley.r1_mm = 16": the file's syntax.
std::string setting_text(const std::string& key, double value);

/// Angles that appear to be in radians.
std::vector<InputWarning> angle_warnings(const DeclaredMechanism& mechanism);
/// Lengths of the mechanism in another unit than mm, one or all.
std::vector<InputWarning> length_warnings(const DeclaredMechanism& mechanism);
/// A modulus in GPa.
std::vector<InputWarning> modulus_warnings(const DeclaredMechanism& mechanism);
/// guides.OE_mm with the opposite sign.
std::vector<InputWarning> sign_warnings(const DeclaredMechanism& mechanism);

}  // namespace fusee::analysis
