/// \file
/// Random designs with a motor, and with lengths in inches.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "fusee/mechanism_file.h"

namespace fusee::testing {

/// Every third design has a motor, every sixth with motor.enforce. Every fourth design is written in inches, with
/// the same lengths. Throws InputError.
inline DeclaredMechanism with_motor_and_units(std::string text, std::uint64_t number, const std::string& name) {
  constexpr std::array<const char*, 4> k_models{"MG996R", "NEMA17-40mm", "SG90", "XL430-W250"};
  if (number % 3 == 1) {
    const std::uint64_t motor = number / 3;
    text += "\n[motor]\nmodel = \"" + std::string(k_models.at(motor / 2 % k_models.size())) + "\"\n";
    if (motor % 2 == 0) text += "enforce = true\n";
  }
  DeclaredMechanism mechanism = parse_mechanism(text, name);
  if (number % 4 != 2) return mechanism;
  mechanism.units = LengthUnit::inch;
  return parse_mechanism(write_mechanism(mechanism), name);
}

}  // namespace fusee::testing
