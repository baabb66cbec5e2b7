/// \file
/// Measured runs of two states of one joint → what changed between them.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fusee/export/comparison.h"

namespace fusee {

struct CompareOptions {
  MeasurementOptions columns;
  std::filesystem::path folder;  ///< where the files go; empty: none are written
  bool force = false;
  bool dry_run = false;  ///< everything but writing
  /// Called with the present step and, where that is known, its share. An exception of it stops the work.
  std::function<void(const std::string& what, std::optional<double> share)> progress;
  /// Called before each file is staged. What it throws leaves nothing behind.
  std::function<void()> before_writing;
};

struct CompareResult {
  ComparisonProduct product;
  std::vector<OutputFile> outputs;  ///< manifest.json last; none without a folder
  bool published = false;
};

/// Reads the runs of both states, held against the joint that `file` describes, and leaves comparison.json, report.html
/// and manifest.json. Files that are no two states of one joint are a verdict, and leave the same files. InputError for
/// what cannot be read and for a run that is given twice, OutputError where it may not be written, before the work.
CompareResult compare(const MechanismFile& file, const std::vector<std::filesystem::path>& before,
                      const std::vector<std::filesystem::path>& after, const CompareOptions& options);

}  // namespace fusee
