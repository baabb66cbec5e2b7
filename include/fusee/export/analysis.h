/// \file
/// What `fusee analyze` found, as a page.
#pragma once

#include <string>
#include <vector>

#include "fusee/analysis/analysis.h"
#include "fusee/base/diagnostics.h"
#include "fusee/mechanism/file.h"

namespace fusee {

/// One page that needs nothing else: the joint moves under a slider, both models' forces, the error budget. Of a law
/// that exists over the range. `said`: what else there is to say of it, on top. The same input gives the same bytes.
std::string analysis_html(const MechanismFile& file, const AnalysisResult& result, const AnalysisOptions& options,
                          const std::vector<Diagnostic>& said);

/// The page's plots as one picture of their own, and the same for programs that take no SVG: InputError where the
/// system has no librsvg.
std::string analysis_svg(const MechanismFile& file, const AnalysisResult& result);
std::string analysis_png(const MechanismFile& file, const AnalysisResult& result);
std::string analysis_pdf(const MechanismFile& file, const AnalysisResult& result);

}  // namespace fusee
