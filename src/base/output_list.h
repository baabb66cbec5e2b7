/// \file
/// Internal: the files of a run as JSON, in manifests and in answers. OutputFolder reads it back to know its own.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "fusee/base/files.h"

namespace fusee {

/// [{"file", "bytes", "sha256"}, …]
nlohmann::ordered_json output_list(const std::vector<OutputFile>& files);

}  // namespace fusee
