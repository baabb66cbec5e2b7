/// \file
/// Internal: the files of a run as JSON, in manifests and in answers. OutputFolder reads it back to know its own.
#pragma once

#include <vector>

#include "base/json.h"
#include "fusee/base/files.h"

namespace fusee {

/// [{"file", "bytes", "sha256"}, …]
Json output_list(const std::vector<OutputFile>& files);

}  // namespace fusee
