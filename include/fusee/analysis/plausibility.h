/// \file
/// A word in time: numbers of a mechanism file that are likelier a slip than a wish. Nothing is refused; a warning
/// names the key, what is odd about it and what may have been meant.
#pragma once

#include <optional>
#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/mechanism/file.h"

namespace fusee {

/// Degrees in radians, lengths in cm or m, moduli in GPa, the sign of OE. In the order of the file's tables.
std::vector<Diagnostic> likely_slips(const MechanismFile& file);

/// Where the declared load pulls the joint's tendons, as they are, beyond what they bear or are likely to.
std::optional<Diagnostic> overloaded_tendon(const MechanismFile& file);

/// Where a pulley of the joint, as it is, bends the tendon tighter than tendon.bend_ratio wants.
std::vector<Diagnostic> tight_bends(const MechanismFile& file);

/// All of these but the bends, which a build says with what else it finds of its curves.
std::vector<Diagnostic> doubts(const MechanismFile& file);
/// The file with them among its warnings.
MechanismFile with_doubts(MechanismFile file);

}  // namespace fusee
