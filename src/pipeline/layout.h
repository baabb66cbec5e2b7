/// \file
/// Internal: the layout of a joint (lever or drum, pins or idlers, one turn or several), chosen by full builds.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "fusee/pipeline.h"

namespace fusee::pipeline {

/// Requirements that a layout must meet.
struct LayoutRequirements {
  /// Link length, range, load, tendon and bore. The layout replaces drum, attachments, guides, pulley place and r1.
  DeclaredMechanism joint;
  double room = 0;    ///< largest diameter of the pulley, mm
  double travel = 0;  ///< largest rotation of the motor, rad; 0: unlimited
  bool any = false;   ///< the first layout that builds suffices
};

/// Makes the file of a candidate, as it would be read from the disk. Throws InputError.
using CandidateFile = std::function<MechanismFile(const DeclaredMechanism&)>;

/// A layout whose full build passes every check, in the room and within the motor's travel.
struct ChosenLayout {
  MechanismFile file;
  std::string words;    ///< "a drum on the joint, tendons over pins"
  BuildResult built;    ///< of a dry run
  double diameter = 0;  ///< of the pulley, mm
  double travel = 0;    ///< rotation of the pulley over the range, rad
  double tension = 0;   ///< tension by the declared load, without pretension, N
  /// About a pretension that keeps both tendons taut under the load; "" if the usual one does.
  std::string pretension_words;
  bool stalls = false;  ///< the motor cannot hold the load
  bool is_held = true;  ///< by a set screw, even if the shaft is too short for it, or a horn, or as the file wants it
  /// Price of holding the pulley on its shaft, or the reason why nothing holds it; "" without a price.
  std::string price_words;
};

struct LayoutSearch {
  std::optional<ChosenLayout> chosen;
  /// Without a choice: why the last candidate that was built, or else the last one, fails; if the motor is too weak for
  /// it, with the least torque of all that were built.
  std::string obstacle;
};

/// Tries candidates by a quick check, then by full dry builds, in order of preference: a lever where the range allows
/// it, a drum with one turn of the pulley, a drum with several turns. No drum is wider than the room. Candidates that the motor turns with its advised
/// margin come first. A candidate is preferred over an earlier one if the motor can hold the load, if its build has
/// fewer warnings, if a horn or a set screw that the shaft reaches holds it, if the motor has more of its advised margin, and if
/// fewer features are omitted, in this order. The choice keeps its room as body.room_diameter_mm, and has
/// the pretension that keeps both tendons taut under the load if tendons and motor bear it.
LayoutSearch choose_layout(const LayoutRequirements& requirements, const CandidateFile& file_of,
                           const RunContext& context);

/// A drum for a file whose lever point cannot cover the range: the changed keys, with which a full build passes every
/// check. Empty if the range is not the obstacle or no drum was found.
std::optional<profile::LayoutAdvice> drum_advice(const MechanismFile& file, const BuildOptions& options,
                                                 const RunContext& context);

}  // namespace fusee::pipeline
