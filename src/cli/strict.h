/// \file
/// --strict: warnings are failures.
#pragma once

#include "cli/arguments.h"
#include "cli/reply.h"

namespace fusee::cli {

Option strict_option();
/// With --strict, a reply that is done but has warnings ends in Exit::check_failed. Call it once everything is written.
void apply_strict(const Arguments& arguments, Reply& reply);

}  // namespace fusee::cli
