/// \file
/// The program from its arguments to its exit code.
#pragma once

#include <string>
#include <vector>

#include "cli/console.h"
#include "cli/reply.h"

namespace fusee::cli {

/// A command that came to its end, good or bad.
struct Ending {
  std::string command;  ///< "" where none was understood
  Reply reply;
  bool json = false;
  /// For stdout.
  std::string result() const { return json ? document(reply, command) : reply.text; }
};

/// `words`: the arguments without the program's name. Never throws; nothing is printed but progress.
Ending ending_of(const std::vector<std::string>& words, Console& console);

/// The same with everything printed, and the exit code. --bundle is seen to here.
int run(const std::vector<std::string>& words);

}  // namespace fusee::cli
