/// \file
/// The end of the program where nothing can be thrown: in a signal handler, or without memory.
#pragma once

#include <string_view>

#include "cli/reply.h"

namespace fusee::cli {

/// Whether exit_at_once() also writes a JSON document to stdout.
void write_json_at_exit(bool json);

/// Writes the error to stderr and ends the program. It allocates nothing and runs no destructor, and may be called in a
/// signal handler. `message` stands in the JSON document as it is: no quotes, no control characters.
[[noreturn]] void exit_at_once(Exit exit, std::string_view message);

}  // namespace fusee::cli
