/// \file
/// Files of a case for other methods of inference: the truth, the catalogue's slopes, and the answer of calibrate().
#pragma once

#include <filesystem>
#include <string>

#include "rig/judge.h"

namespace fusee::rig {

/// Mechanism and runs as calibrate() reads them.
struct CaseInput {
  DeclaredMechanism declared;
  measurement::Measurement measurement;
};
/// Reads the files of write_case() back.
CaseInput read_case(const Case& made, const std::filesystem::path& folder);

/// The answer of calibrate() with its processor time. Calibrations that run at the same time count together.
struct TimedAnswer {
  calibration::Calibration found;
  double seconds = 0;
};

/// Writes case.json (truth and, unless null, answer) and slopes.csv beside the files of write_case(). `kind`: the row
/// of the matrix. OutputError if a file cannot be written.
///
/// slopes.csv has at most 200 rows of each run, evenly spaced, in degrees. Columns: run, time_s, alpha_deg, theta_deg,
/// load_N, direction (of the motor), declared_deg (prediction of the declared joint). Then one column for each fitted
/// number of each effect, EFFECT/NUMBER/START: the change of the predicted joint angle for a step of the number. START
/// 0 is the derivative at the declared joint. Other starts are chords to the values at which a search would begin.
void write_case_data(const Case& made, const std::string& kind, const TimedAnswer* answer,
                     const std::filesystem::path& folder);

}  // namespace fusee::rig
