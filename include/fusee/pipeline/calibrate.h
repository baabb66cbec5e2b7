/// \file
/// Measured runs of a joint → what is off, why, and the file of a better pulley.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fusee/export/calibration.h"

namespace fusee {

struct CalibrateOptions {
  MeasurementOptions columns;
  std::vector<std::filesystem::path> hold_out;  ///< runs to validate with only
  std::filesystem::path folder;                 ///< where the files go
  bool force = false;
  bool dry_run = false;  ///< everything but writing
  bool audit = true;     ///< CalibrationOptions::audit
  /// What is done now and, where that is known, how much of it. What it throws stops the work.
  std::function<void(const std::string& what, std::optional<double> share)> progress;
  /// Called before each file is staged. What it throws leaves nothing behind.
  std::function<void()> before_writing;
};

struct CalibrateResult {
  CalibrationProduct product;
  std::vector<OutputFile> outputs;  ///< manifest.json last
  bool published = false;
  bool rewritten = false;  ///< corrected.toml has every key: the text of `file.path` says something else (--set)
};

/// Reads the runs, holds them against the joint as `file` describes it, and leaves calibration.json, corrected.toml
/// (with the table of law = "table" beside it), compensation.csv, report.html and manifest.json. Data that decide
/// nothing are a verdict; InputError for what cannot be read, OutputError where it may not be written, before the work.
/// A run that is both fitted and held out is held out. corrected.toml keeps the text of `file.path`, comments and
/// all, where that says what `file.mechanism` is.
CalibrateResult calibrate(const MechanismFile& file, const std::vector<std::filesystem::path>& runs,
                          const CalibrateOptions& options);

}  // namespace fusee
