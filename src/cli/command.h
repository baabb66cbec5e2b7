/// \file
/// A command of the program: name, help texts as data, and a function from arguments to a reply. Help, parsing,
/// suggestions for misspelt options and the tests of the examples use this one table.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/console.h"
#include "cli/reply.h"
#include "fusee/base.h"

namespace fusee::cli {

/// A command line to copy, and its purpose.
struct Example {
  std::string_view line;
  std::string_view effect;
};

struct Command {
  std::string_view name;
  std::string_view positionals;  ///< "SPEC FILE", "[KEY]": brackets mark optional arguments
  std::string_view summary;      ///< one line in the list of commands
  std::string_view description;  ///< one paragraph for a first-time user
  std::vector<Option> options;   ///< in addition to common_options()
  std::vector<Example> examples;
  std::function<Reply(const Arguments&, Console&, const RunContext&)> run;
  std::string_view required_options = {};  ///< options without which it does not run, as the usage shows them
};

/// "compare SPEC --before FILE...": name, arguments and required options.
std::string synopsis(const Command& command);

// One file a command.
Command new_command();
Command explain_command();
Command analyze_command();
Command build_command();
Command check_command();
Command rewind_command();
Command optimize_command();
Command reproduce_command();
Command calibrate_command();
Command compare_command();
Command plan_command();
Command kit_command();
Command model_command();
Command simulate_command();
Command replay_command();
Command completion_command();
Command manual_command();

/// All commands, in the order of the help.
const std::vector<Command>& commands();
/// Throws UsageError with the nearest name.
const Command& find_known_command(const std::string& name);

}  // namespace fusee::cli
