/// \file
/// Internal: the CSV files of law = "table" and law = "torque".
#pragma once

#include <string_view>
#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// Rows of `alpha_deg, theta_deg`: '#' comments, blank lines, CRLF and a byte order mark are passed over. Everything
/// wrong is added to `problems` with file and line: columns, numbers, at least 4 rows, both columns increasing, the
/// joint's range covered, home kept (θ(0) = 0 within 0.01°).
std::vector<LawRow> parse_law_table(std::string_view csv, const std::string& file, const Joint& joint,
                                    std::vector<Diagnostic>& problems);

/// Rows of `theta_deg, motor_torque_Nmm`, read as strictly: at least 4 and at most 2000, the angles increasing, the
/// joint's range covered.
std::vector<TorqueRow> parse_torque_table(std::string_view csv, const std::string& file, const Joint& joint,
                                          std::vector<Diagnostic>& problems);

}  // namespace fusee
