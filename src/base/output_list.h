/// \file
/// Internal: the output files as JSON, for manifests and answers. OutputFolder reads it back to recognize its own
/// files.
#pragma once

#include <vector>

#include "base/json.h"
#include "fusee/base.h"

namespace fusee {

/// [{"file", "bytes", "sha256"}, …]
Json output_list(const std::vector<OutputFile>& files);

}  // namespace fusee
