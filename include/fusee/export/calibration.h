/// \file
/// Outputs of `fusee calibrate`, as bytes.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "fusee/base/files.h"
#include "fusee/calibration/slips.h"
#include "fusee/correction/correction.h"
#include "fusee/correction/rehearsal.h"
#include "fusee/mechanism/file.h"

namespace fusee {

/// All that is known after a calibration.
struct CalibrationProduct {
  MechanismFile file;
  Measurement measurement;
  Calibration calibration;
  std::vector<LikelyInputError> slips;  ///< of the file or of the data, that would explain what no effect does
  Correction correction;
  Rehearsal rehearsal;  ///< of what was found
};

std::string calibration_json(const CalibrationProduct& product);
/// The measurements to make next, for the bench: a page and the run files, "next/run_6.csv". None where nothing is asked
/// for.
std::vector<OutputFile> next_files(const CalibrationProduct& product);
/// The file of calibration.next[i]: "next/run_6.csv", numbered after the runs that were read; "" where it is no run.
std::string next_file_name(const CalibrationProduct& product, std::size_t i);
/// The number of the first run file of a plan beside runs of these names: one more than the largest of "run_5.csv".
int first_free_run(const std::vector<std::string>& names);
/// Names of next_files() with so many runs.
std::vector<std::string> next_file_names(int first_run, int runs);
std::string calibration_report_html(const CalibrationProduct& product);
/// Names the files beside it, so that the next run knows them as ours.
std::string calibration_manifest_json(const CalibrationProduct& product, const std::vector<OutputFile>& outputs);

// ---- what a person reads first ----

/// 60 words at most, without identifiers.
struct Headline {
  std::string problem;  ///< what the joint does wrong, and by how much
  std::string cause;    ///< one, or two or three candidates; "" where there is none
  std::string action;   ///< what to do now
};
Headline headline(const CalibrationProduct& product);

/// A number of a cause. Share and remedy are empty for its further numbers, and for causes that may be in its place.
struct CauseRow {
  std::string cause;
  std::string size;
  std::string interval;      ///< 95 %, if this is the only cause
  std::string share;         ///< of the error on rows that were not fitted
  std::string corrected_by;  ///< "pulley", "table" or "–"

  /// Titles of the columns, in the order of the members.
  static constexpr std::array<const char*, 5> k_titles = {"cause", "size", "95 % if alone", "share", "corrected by"};
};
std::vector<CauseRow> cause_rows(const CalibrationProduct& product);

// ---- in words, for the page and for a terminal alike ----

/// "EA = 4515 N (95 %: 4479 … 4551 if nothing else is there, else 4420 … 4610)": the unit is taken from the end of the
/// name; `load_unit` is that of the load column.
std::string parameter_words(const FittedParameter& parameter, const std::string& load_unit);
/// The group without the effect itself.
std::vector<std::string> rivals_of(const FoundEffect& effect);
/// Says that P1 stays round, and by how much it misses its law.
std::string round_words(const Correction& correction);
/// Why no corrected pulley can be made, of a correction that says so.
std::string infeasible_words(const Correction& correction);
/// The assembly angle of a corrected pulley, if the correction requires another than 0.
std::string tied_words(const Correction& correction);
/// Effects that were not found by the smallest size that would have shown, rad; what is equal to two digits stands
/// together. Smallest first.
std::vector<std::pair<double, std::vector<std::string>>> detectable_groups(const Calibration& calibration);
/// The part of the unmodelled residual that the table covers, and where that holds; or why it covers none. "" if
/// nothing is unmodelled.
std::string curve_words(const CalibrationProduct& product);
/// All measurements to make next, the most decisive first.
std::vector<std::string> next_texts(const Calibration& calibration);
/// slip_words() of every input error that would explain the data.
std::vector<std::string> slips_words(const CalibrationProduct& product);
/// Two of the notes that say the same of many files, and the number of others.
std::vector<std::string> shortened_notes(const std::vector<std::string>& notes);

}  // namespace fusee
