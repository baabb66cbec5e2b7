/// \file
/// Internal: the CSV files of law = "table" and law = "torque".
#pragma once

#include <string_view>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"

namespace fusee {

/// Parses rows of `alpha_deg, theta_deg`. '#' comments, blank lines, CRLF and a byte order mark are skipped. `problems`
/// receives errors with file and line, about 20 at most: columns, numbers, fewer than 4 rows, columns that do not
/// increase, a range smaller than the joint's, a missing home (θ(0) = 0 within 0.01°).
std::vector<LawRow> parse_law_table(std::string_view csv, const std::string& file, const Joint& joint,
                                    std::vector<Diagnostic>& problems);

/// Parses rows of `theta_deg, motor_torque_Nmm` equally strictly: 4 to 2000 rows, increasing angles, the joint's range
/// covered.
std::vector<TorqueRow> parse_torque_table(std::string_view csv, const std::string& file, const Joint& joint,
                                          std::vector<Diagnostic>& problems);

}  // namespace fusee
