/// \file
/// The result of `optimize` as text and JSON.
#pragma once

#include "cli/reply.h"
#include "fusee/pipeline.h"

namespace fusee::cli {

/// Adds the design, or the reason why there is none. `path`: the mechanism file.
void add_answer(const std::string& path, const pipeline::OptimizeOptions& options,
                const pipeline::OptimizeResult& result, Reply& reply);
/// Adds the written files.
void add_files(const pipeline::OptimizeOptions& options, const pipeline::OptimizeResult& result, Reply& reply);

}  // namespace fusee::cli
