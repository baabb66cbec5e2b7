/// \file
/// What `fusee compare` says and leaves behind, as words and bytes.
#pragma once

#include <string>
#include <vector>

#include "fusee/base/files.h"
#include "fusee/calibration/comparison.h"
#include "fusee/mechanism/file.h"

namespace fusee {

/// All that is known after a comparison.
struct ComparisonProduct {
  MechanismFile file;
  Measurement measurement;      ///< the runs before, then the runs after
  std::size_t runs_before = 0;  ///< how many of them
  Comparison comparison;
};

std::string comparison_json(const ComparisonProduct& product);
std::string comparison_report_html(const ComparisonProduct& product);
/// Names the files beside it, so that the next run knows them as ours.
std::string comparison_manifest_json(const ComparisonProduct& product, const std::vector<OutputFile>& outputs);

/// The answer in at most 60 words, without identifiers: what changed, by how much, what to do.
std::string comparison_words(const ComparisonProduct& product);
/// The largest of the changes that would just have been seen, rms at the joint, rad; 0 where none was asked for.
double least_seen(const Comparison& comparison);

/// A row of the table of changes.
struct ChangeRow {
  std::string cause;      ///< "pretension of tendon 1"
  std::string change;     ///< "−4.20 N"
  std::string states;     ///< "20.0 → 15.8"
  std::string interval;   ///< "−4.60 … −3.80 N"
  std::string share;      ///< how much of the difference between the states, "" but in an effect's first row
  std::string as_likely;  ///< the other members of its group, "" but in an effect's first row
};
std::vector<ChangeRow> change_rows(const ComparisonProduct& product);

}  // namespace fusee
