/// \file
/// Calibration: measured runs → causes of the error, and the file of a better pulley.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fusee/export/calibration.h"

namespace fusee {

struct CalibrateOptions {
  MeasurementOptions columns;
  std::vector<std::filesystem::path> hold_out;  ///< runs for validation only
  std::filesystem::path folder;                 ///< folder of the output files
  bool force = false;
  bool dry_run = false;  ///< everything except writing
  bool audit = true;     ///< CalibrationOptions::audit
};

struct CalibrateResult {
  CalibrationProduct product;
  std::vector<OutputFile> outputs;  ///< manifest.json last
  bool published = false;
  /// corrected.toml has every key, because the text of `file.path` differs from the mechanism (--set)
  bool rewritten = false;
};

/// Reads the runs, compares them with the joint of `file`, and writes calibration.json, corrected.toml (with the CSV of
/// a law table), compensation.csv, report.html and manifest.json. Inconclusive data give a verdict. Throws InputError
/// for unreadable input, and OutputError before the work if the output may not be written. A run that is both fitted
/// and held out is held out. corrected.toml keeps the text of `file.path` with comments if it describes
/// `file.mechanism`.
CalibrateResult calibrate(const MechanismFile& file, const std::vector<std::filesystem::path>& runs,
                          const CalibrateOptions& options, const RunContext& context = {});

}  // namespace fusee
