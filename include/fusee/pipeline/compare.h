/// \file
/// Comparison: measured runs of two states of one joint → the changes between them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fusee/export/comparison.h"

namespace fusee {

struct CompareOptions {
  MeasurementOptions columns;
  std::filesystem::path folder;  ///< folder of the output files; empty: no files
  bool force = false;
  bool dry_run = false;  ///< everything except writing
};

struct CompareResult {
  ComparisonProduct product;
  std::vector<OutputFile> outputs;  ///< manifest.json last; empty without a folder
  bool published = false;
};

/// Reads the runs of both states, compares them with the joint of `file`, and writes comparison.json, report.html and
/// manifest.json. Files that are not two states of one joint give a verdict and the same files. Throws InputError for
/// unreadable input and for a repeated run, and OutputError before the work if the output may not be written.
CompareResult compare(const MechanismFile& file, const std::vector<std::filesystem::path>& before,
                      const std::vector<std::filesystem::path>& after, const CompareOptions& options,
                      const RunContext& context = {});

}  // namespace fusee
