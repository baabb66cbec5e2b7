/// \file
/// Exits from a signal handler or when memory has run out, where nothing can be thrown or allocated.
#pragma once

#include <string_view>

#include "cli/reply.h"

namespace fusee::cli {

/// Sets whether exit_at_once() also writes a JSON document to stdout.
void write_json_at_exit(bool json);

/// Writes the error to stderr and exits. Allocates nothing, runs no destructors, and is safe in a signal handler.
/// `message` is copied into the JSON document, so it must have no quotes and no control characters.
[[noreturn]] void exit_at_once(Exit exit, std::string_view message);

}  // namespace fusee::cli
