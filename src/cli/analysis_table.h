/// \file
/// The stroke of `analyze` as columns: for a terminal, for CSV and for JSON.
#pragma once

#include <string>
#include <vector>

#include "cli/reply.h"
#include "fusee/analysis/analysis.h"

namespace fusee::cli {

/// Three tables within 80 columns: geometry, forces, what gives way. Every row, or 13 of them.
std::string stroke_tables(const std::vector<AnalysisRow>& rows, bool all);
/// One line a row; an empty cell where there is no equilibrium.
std::string stroke_csv(const std::vector<AnalysisRow>& rows);
/// The same as a list of objects; null where there is no equilibrium.
Json stroke_json(const std::vector<AnalysisRow>& rows);

}  // namespace fusee::cli
