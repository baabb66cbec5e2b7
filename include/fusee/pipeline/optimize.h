/// \file
/// Options and result of fusee optimize.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fusee/base/files.h"
#include "fusee/mechanism/file.h"
#include "fusee/optimize/certified.h"
#include "fusee/optimize/genetic.h"

namespace fusee {

/// Search methods, in the order of OptimizeResult::search.
enum class SearchMethod { certified, genetic, pareto };

/// The most rigorous method that supports the objectives and variables of [optimize].
SearchMethod strongest_method(const MechanismFile& file);

struct OptimizeOptions {
  std::optional<SearchMethod> method;  ///< default: strongest_method()
  std::optional<Objective> then;       ///< certified: second objective that selects among tied designs
  GeneticOptions genetic;              ///< for genetic and pareto
  /// settings with which the file was read; numbers among them go into the new files
  std::vector<Setting> settings;
  std::filesystem::path new_file;      ///< path of the mechanism with the new numbers; empty: none
  std::filesystem::path front_folder;  ///< folder of the front's mechanisms; empty: none
  bool force = false;
  bool dry_run = false;  ///< everything except publishing
};

struct OptimizeResult {
  Problem problem;
  std::variant<CertifiedResult, GeneticResult, ParetoResult> search;
  std::optional<CertifiedResult> then;  ///< the second search of OptimizeOptions::then
  bool found = false;
  bool stopped = false;  ///< by RunContext::stop: the best design so far
  std::string reason;    ///< if nothing was found: the most frequent cause
  Design design;         ///< best design, in the file's declared numbers; for a front its most balanced point
  double value = 0;      ///< of the first objective
  double theta = 0;      ///< θ at which the objective takes its value, rad; not for a front
  Evaluation before;     ///< first objective of the unchanged file
  std::string new_text;  ///< text of the file with the design's numbers; empty if not requested
  std::vector<OutputFile> front_files;
  std::vector<Diagnostic> warnings;  ///< plausibility warnings about the file, and settings that the new files omit
  bool published = false;

  SearchMethod method() const { return static_cast<SearchMethod>(search.index()); }
};

}  // namespace fusee
