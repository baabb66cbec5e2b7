/// \file
/// The program, from its arguments to its exit code.
#pragma once

#include <string>
#include <vector>

#include "cli/console.h"
#include "cli/reply.h"
#include "fusee/base.h"

namespace fusee::cli {

/// Result of a command that ended, successful or not.
struct CommandOutcome {
  std::string command;  ///< "" if no command was recognised
  Reply reply;
  bool json = false;
  /// Text for stdout.
  std::string result() const { return json ? document(reply, command) : reply.text; }
};

/// Runs a command. `words`: the arguments without the program's name. Never throws, and prints only progress:
/// the console takes the place of `context.progress`.
CommandOutcome run_command(const std::vector<std::string>& words, Console& console, RunContext context);

/// Runs a command, also one with --bundle, prints everything and returns the exit code.
int run(const std::vector<std::string>& words);

}  // namespace fusee::cli
