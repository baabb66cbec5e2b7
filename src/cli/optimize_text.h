/// \file
/// The answer of `optimize` in words and as JSON.
#pragma once

#include "cli/reply.h"
#include "fusee/pipeline/optimize.h"

namespace fusee::cli {

/// What was found, or why nothing was. `path` of the mechanism file.
void add_answer(const std::string& path, const OptimizeOptions& options, const OptimizeResult& result, Reply& reply);
/// The files that were written.
void add_files(const OptimizeOptions& options, const OptimizeResult& result, Reply& reply);

}  // namespace fusee::cli
