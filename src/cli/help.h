/// \file
/// The texts of --help, from the table of commands.
#pragma once

#include <string>

#include "cli/command.h"

namespace fusee::cli {

/// Meaning of an exit code.
struct ExitWords {
  Exit exit;
  std::string_view words;
};
const std::vector<ExitWords>& exit_words();

std::string main_help();
std::string command_help(const Command& command);

}  // namespace fusee::cli
