/// \file
/// What fusee optimize is asked, and what it answers.
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

/// In the order of OptimizeResult::search.
enum class SearchMethod { certified, genetic, pareto };

/// Of those that can do what [optimize] asks for, the one that can prove most.
SearchMethod strongest_method(const MechanismFile& file);

struct OptimizeOptions {
  std::optional<SearchMethod> method;  ///< left out: strongest_method()
  std::optional<Objective> then;       ///< certified: the best by this among the designs that tie
  GeneticOptions genetic;              ///< of genetic and pareto, but for its keep_going
  KeepGoing keep_going;                ///< of every method; a search that it stops answers with the best so far
  std::vector<Setting> settings;       ///< that the file was read with: the numbers among them go into the new files
  std::filesystem::path new_file;      ///< where the mechanism with its new numbers goes; empty: nowhere
  std::filesystem::path front_folder;  ///< where each point of a front goes as a mechanism; empty: nowhere
  bool force = false;
  bool dry_run = false;  ///< everything but publishing
};

struct OptimizeResult {
  Problem problem;
  std::variant<CertifiedResult, GeneticResult, ParetoResult> search;
  std::optional<CertifiedResult> then;  ///< the second search of OptimizeOptions::then
  bool found = false;
  bool stopped = false;  ///< by keep_going
  std::string reason;    ///< when nothing was found: the commonest cause
  Design design;         ///< the best, in the file's declared numbers; of a front the point that is best balanced
  double value = 0;      ///< of the first objective
  double theta = 0;      ///< where in the range it is taken, rad; not of a front
  Evaluation before;     ///< of the first objective, by the file as it is
  std::string new_text;  ///< the person's file with the design's numbers; empty when none was asked for
  std::vector<OutputFile> front_files;
  std::vector<Diagnostic> warnings;  ///< doubts about the file as it is, and what the new files could not keep
  bool published = false;

  SearchMethod method() const { return static_cast<SearchMethod>(search.index()); }
};

}  // namespace fusee
