/// \file
/// Sharpness of answers: sizes of groups, widths of intervals over the Cramér-Rao bound, and separation of the joints
/// that have an unmodelled fault.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rig/case_data.h"

namespace fusee::rig {

/// The sharpness of one answer.
struct Sharpness {
  bool has_unmodelled = false;           ///< a fault of the joint is not in the catalogue
  double unmodelled_log_odds = 0;        ///< for an unmodelled cause, as answered
  std::vector<std::size_t> group_sizes;  ///< members of each reported group, with `unmodelled`
  /// Widths of the 95 % intervals over those of the Cramér-Rao bound, for numbers of reported effects that are faults
  /// of the joint.
  std::vector<double> widths;
  std::vector<double> widths_if_only;  ///< the same for `ci95_if_only`
};

/// The log odds for an unmodelled cause, between −1000 and 1000: of the discrepancy beside all effects, or of the best
/// alternative to an effect, whichever is more. 1000 if the runs are not repeatable, −1000 without any evidence.
double unmodelled_log_odds(const calibration::Calibration& found);

/// The Cramér-Rao bound takes all rows, the sensor's true noise, and the reported effects that are faults of the joint
/// as the only unknown ones. `input`: the files of the case.
Sharpness sharpness_of(const Case& made, const CaseInput& input, const Answer& answer);

/// Probability that a score of `positive` exceeds one of `negative`; equal scores count half. NaN if either is empty.
double area_under_roc(const std::vector<double>& positive, const std::vector<double>& negative);

/// A table in Markdown.
std::string sharpness_table(const std::vector<Sharpness>& all);

}  // namespace fusee::rig
