/// \file
/// What calibration made of a case, held against the truth.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fusee/calibration/calibration.h"
#include "rig/truths.h"

namespace fusee::rig {

/// One joint's answer.
struct Judgement {
  std::string truth;
  CalibrationVerdict verdict = CalibrationVerdict::not_testable;
  std::size_t named = 0;         ///< faults that have a name
  std::size_t held = 0;          ///< of these, in a reported group
  std::size_t alone = 0;         ///< of these, named alone
  std::size_t false_groups = 0;  ///< reported groups that hold neither a fault nor its kin
  std::size_t wrong_alone = 0;   ///< of these, with a single member
  bool outside = false;          ///< a fault without a name is there
  std::string words;             ///< one line for a person
};

Judgement judge(const Case& made, const Calibration& found);

/// Its files; returns the runs.
std::vector<std::filesystem::path> write_case(const Case& made, const std::filesystem::path& folder);
/// Writes them, and calibrates what is read back.
Judgement calibrate_case(const Case& made, const std::filesystem::path& folder);

/// Rows = truths, columns = counts; the rates and their definitions below.
std::string matrix(const std::vector<Judgement>& judgements);

struct Rates {
  double miss = 0;                 ///< share of named faults that stand in no reported group
  double false_blame = 0;          ///< share of joints with a false group, all faults named or nothing there
  double false_blame_outside = 0;  ///< the same of joints with a fault without a name
  double wrong_alone = 0;          ///< share of all joints in which something was named alone that is not there
  double unexplained_outside =
      0;             ///< share of joints with a fault without a name that were called unexplained or not_repeatable
  double quiet = 0;  ///< share of joints as declared that were called no_effect
};
Rates rates(const std::vector<Judgement>& judgements);

}  // namespace fusee::rig
