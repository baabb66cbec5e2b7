/// \file
/// Internal: writes a design into the user's file.
#pragma once

#include "fusee/mechanism_file.h"
#include "fusee/optimize.h"

namespace fusee::pipeline {

struct DesignFile {
  std::string text;
  std::vector<Diagnostic> warnings;  ///< about settings that could not be kept
};

/// `file` with the design's numbers at their keys, and with the numeric values of `settings`.
DesignFile design_file(const MechanismFile& file, const optimize::Problem& problem, const optimize::Design& design,
                       const std::vector<Setting>& settings, FileAccess& files);

}  // namespace fusee::pipeline
