/// \file
/// Internal: a design in the person's own file.
#pragma once

#include "fusee/mechanism/file.h"
#include "fusee/optimize/problem.h"

namespace fusee {

struct DesignFile {
  std::string text;
  std::vector<Diagnostic> warnings;  ///< of what it could not keep
};

/// `file` with the design's numbers where their keys stand. What `settings` gave and is a number goes in too.
DesignFile design_file(const MechanismFile& file, const Problem& problem, const Design& design,
                       const std::vector<Setting>& settings);

}  // namespace fusee
