/// \file
/// The texts of --help, made from the table of commands.
#pragma once

#include <string>

#include "cli/command.h"

namespace fusee::cli {

std::string main_help();
std::string command_help(const Command& command);

}  // namespace fusee::cli
