/// \file
/// Internal: what looks like a slip, before it has a place in a file.
#pragma once

#include <string>
#include <vector>

#include "fusee/mechanism/mechanism.h"

namespace fusee {

struct LikelySlip {
  std::string key;      ///< that the warning stands at
  std::string message;  ///< what is odd, with the value and its unit
  std::string hint;     ///< what may have been meant
};

/// The number of the key in the file's unit.
double declared_number(const DeclaredMechanism& mechanism, const char* key);
/// "pulley.r1_mm = 16": what a person would write.
std::string setting_text(const std::string& key, double value);

/// Angles that look like radians.
std::vector<LikelySlip> slipped_angles(const DeclaredMechanism& mechanism);
/// Lengths of the mechanism in another unit than mm, one of them or all; a modulus in GPa.
std::vector<LikelySlip> slipped_lengths(const DeclaredMechanism& mechanism);
std::vector<LikelySlip> slipped_modulus(const DeclaredMechanism& mechanism);
/// guides.OE_mm with the other sign.
std::vector<LikelySlip> slipped_sign(const DeclaredMechanism& mechanism);

}  // namespace fusee
