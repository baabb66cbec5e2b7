/// \file
/// The whole loop: a joint with a hidden fault is measured, calibrated, given the corrected pulley, and measured again
/// with the same fault.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fusee/correction.h"
#include "rig/rig.h"

namespace fusee::rig {

/// A fault that a pulley can correct.
struct LoopCase {
  std::string name;  ///< of the effect
  HiddenFaults hidden;
  std::vector<RunPlan> plans;
  double load = 0;  ///< load of the compared runs, N: where stretch matters, the mean of the plans' loads
};

/// A case of each kind of fault, on the forearm-sized joint and on others.
std::vector<LoopCase> loop_cases(const DeclaredMechanism& declared, double load);

/// Result of one turn of the loop. rad, rms of θ − θ(α) as declared, one unloaded or evenly loaded run without noise.
struct LoopOutcome {
  std::string name;
  std::string found;  ///< reported effects
  std::string verdict;
  double before = 0;
  double after = 0;  ///< with the corrected pulley, tendons tied at Correction::assembly_angle
  double after_assembled_at_zero = 0;
  double after_table = 0;  ///< as after_assembled_at_zero, with compensation.csv in the controller
  double declared = 0;     ///< without any fault: friction, declared stretch and the polygon remain
  double predicted = 0;    ///< calibrate's prediction of `after`
  std::string corrected_toml;
};

/// The joint with the pulley that `fusee build` makes of `corrected`, on the bench of `declared`.
MadeJoint with_corrected_pulley(const MadeJoint& declared, const DeclaredMechanism& corrected);

/// Error of the same joint with another pulley, its motor's zero moved by `assembly_angle`. rad rms.
double joint_error(const MadeJoint& joint, const LoopCase& hidden, double assembly_angle);

/// The data of a case as a bench would leave them; scratch files go to `folder`.
measurement::Measurement measured(const MadeJoint& joint, const LoopCase& hidden, const std::filesystem::path& folder);

/// `spec` is the text of the joint's file.
LoopOutcome turn_loop(const MadeJoint& joint, const std::string& spec, const LoopCase& hidden,
                      const std::filesystem::path& folder);

}  // namespace fusee::rig
