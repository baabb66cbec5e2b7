/// \file
/// The result of `fusee analyze` as a page.
#pragma once

#include <string>
#include <vector>

#include "fusee/analysis.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee::formats {

/// A self-contained page: the joint moves under a slider, with the forces by the full model and by the paper's formulas,
/// and the error budget. Requires a law that exists over the range. `remarks`: shown at the top. The same input gives
/// the same bytes.
std::string analysis_html(const MechanismFile& file, const analysis::AnalysisResult& result,
                          const analysis::AnalysisOptions& options, const std::vector<Diagnostic>& remarks);

/// The page's plots as one SVG picture, and as PNG or PDF. Throws InputError if the system has no librsvg.
std::string analysis_svg(const MechanismFile& file, const analysis::AnalysisResult& result);
std::string analysis_png(const MechanismFile& file, const analysis::AnalysisResult& result);
std::string analysis_pdf(const MechanismFile& file, const analysis::AnalysisResult& result);

}  // namespace fusee::formats
