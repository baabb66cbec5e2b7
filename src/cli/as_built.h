/// \file
/// Limits of the pulley as built, and the presentation of checks, for `build`, `check` and `rewind`.
#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/reply.h"
#include "fusee/pipeline.h"

namespace fusee::cli {

/// --max-theta-error-deg and --max-slack-mm.
const std::vector<Option>& limit_options();
pipeline::AsBuiltLimits limits_from(const Arguments& arguments);

/// Summary, such as "theta within 0.0012 deg, excess length within 0.003 mm".
std::string as_built_text(const profile::RewindResult& as_built);
/// The object "as_built", as in manifest.json.
Json to_json(const profile::RewindResult& as_built);
std::string checks_table(const std::vector<Check>& checks);
/// Adds an error for each failed check.
void add_failures(const std::vector<Check>& checks, Reply& reply);

}  // namespace fusee::cli
