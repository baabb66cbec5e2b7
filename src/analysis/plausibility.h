/// \file
/// Plausibility checks: numbers of a mechanism file that are likely input errors. Nothing is rejected; a warning names
/// the key, the oddity and the likely intention.
#pragma once

#include <optional>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee::analysis {

/// Likely input errors, in this order: angles in radians, lengths in another unit than mm, the sign of OE, a modulus in
/// GPa.
std::vector<Diagnostic> likely_input_errors(const MechanismFile& file);

/// Warning where the declared load stresses the identified joint's tendons beyond their known or estimated strength.
std::optional<Diagnostic> overloaded_tendon(const MechanismFile& file);

/// Warnings where a pulley of the identified joint bends the tendon more tightly than tendon.bend_ratio.
std::vector<Diagnostic> tight_bends(const MechanismFile& file);

/// All warnings except those about bends, which a build reports with its curves.
std::vector<Diagnostic> plausibility_warnings(const MechanismFile& file);
/// The file with these warnings added.
MechanismFile with_plausibility_warnings(MechanismFile file);

}  // namespace fusee::analysis
