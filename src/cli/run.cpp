#include "cli/run.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <system_error>

#include "cli/command.h"
#include "cli/help.h"
#include "cli/immediate_exit.h"
#include "cli/interrupt.h"
#include "cli/lack_of_memory.h"
#include "cli/recording.h"
#include "fusee/base.h"

namespace fusee::cli {
namespace {

constexpr const char* k_version = FUSEE_VERSION;

/// The first mechanism file of this folder by name; "" if there is none, or if the run is recorded or replayed, since a
/// bundle has no folder listing.
std::string first_mechanism_in_folder(const FileAccess& files) {
  constexpr std::size_t k_most_files = 100;  // so that a large folder does not delay the overview
  constexpr int k_most_lines = 100;
  std::vector<std::string> names;
  if (files.is_bundled()) return "";
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(".", error)) {
    if (names.size() < k_most_files && entry.path().extension() == ".toml" && entry.is_regular_file(error))
      names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  const auto found = std::find_if(names.begin(), names.end(), [](const std::string& name) {
    std::ifstream file(name);
    std::string line;
    for (int i = 0; i < k_most_lines && std::getline(file, line); ++i) {
      if (line.rfind("schema", 0) == 0) return true;  // the key that every mechanism file has
    }
    return false;
  });
  return found == names.end() ? "" : *found;
}

Reply help_reply(const std::string& text) {
  Reply reply;
  reply.text = text;
  reply.fields["help"] = text;
  return reply;
}

Reply version_reply() {
  Reply reply;
  reply.text = std::string("fusee ") + k_version + "\n";
  reply.fields["tool"] = "fusee";
  reply.fields["version"] = k_version;
  return reply;
}

/// The overview, and the next command for this folder.
Reply overview_reply(const FileAccess& files) {
  const std::string spec = first_mechanism_in_folder(files);
  const std::string next = spec.empty() ? "Begin with 'fusee new forearm > arm.toml', then 'fusee build arm.toml'."
                                        : "'fusee build " + spec + "' makes the pulley of " + spec + ".";
  return help_reply(main_help() + next + "\n");
}

Reply reply_without_command(const std::vector<std::string>& words, const FileAccess& files) {
  if (has_switch(words, "--version")) return version_reply();
  return has_switch(words, "--help") || has_switch(words, "-h") ? help_reply(main_help()) : overview_reply(files);
}

/// Replaces "help build" by "build --help".
std::vector<std::string> without_help_command(std::vector<std::string> words) {
  const auto command_index = find_command(words);
  if (!command_index || words[*command_index] != "help") return words;
  words.erase(words.begin() + static_cast<std::ptrdiff_t>(*command_index));
  words.push_back("--help");
  return words;
}

/// Parses the command line and runs its command, a help request or the overview.
Reply dispatch(const std::vector<std::string>& given, std::string& command_name, Console& console,
               const RunContext& context) {
  std::vector<std::string> words = without_help_command(given);
  const auto command_index = find_command(words);
  if (!command_index) return reply_without_command(words, *context.files);
  const Command& command = find_known_command(words[*command_index]);
  command_name = command.name;
  words.erase(words.begin() + static_cast<std::ptrdiff_t>(*command_index));
  const Arguments arguments(command, words);
  console.set_options({arguments.has("--quiet"), arguments.has("--verbose"), arguments.has("--no-color")});
  if (arguments.has("--help")) return help_reply(command_help(command));
  if (arguments.has("--version")) return version_reply();
  Reply reply = command.run(arguments, console, context);
  convert_to_file_units(reply);
  return reply;
}

Reply failure_reply(Exit exit, Diagnostic diagnostic) {
  Reply reply;
  reply.exit = exit;
  reply.diagnostics.push_back(std::move(diagnostic));
  return reply;
}

Reply bug_reply(const std::string& message) {
  return failure_reply(
      Exit::bug, make_diagnostic(Severity::error, message + ": this is a bug in fusee",
                                 "please report it, with the file bug.zip of the same command with --bundle bug.zip"));
}

Reply out_of_memory_reply() {
  return failure_reply(Exit::cannot_write,
                       make_diagnostic(Severity::error, k_no_memory,
                                       "end other programs, raise the limit (ulimit -v), or use a smaller file"));
}

/// Converts exceptions into exit codes; the only such place.
Reply dispatch_safely(const std::vector<std::string>& words, std::string& command_name, Console& console,
                      const RunContext& context) {
  try {
    return dispatch(words, command_name, console, context);
  } catch (const UsageError& error) {
    return failure_reply(Exit::usage, make_diagnostic(Severity::error, error.what(), error.hint()));
  } catch (const InputError& error) {
    Reply reply;
    reply.exit = Exit::bad_input;
    reply.diagnostics = error.diagnostics();
    return reply;
  } catch (const OutputError& error) {
    return failure_reply(Exit::cannot_write, make_diagnostic(Severity::error, error.what(), error.hint()));
  } catch (const Stopped& error) {
    return failure_reply(Exit::interrupted, make_diagnostic(Severity::error, error.what()));
  } catch (const std::bad_alloc&) {
    return out_of_memory_reply();
  } catch (const std::system_error& error) {  // no memory for a thread's stack
    return error.code() == std::errc::resource_unavailable_try_again ? out_of_memory_reply() : bug_reply(error.what());
  } catch (const std::exception& error) {
    return bug_reply(error.what());
  } catch (...) {
    return bug_reply("unknown exception");
  }
}

}  // namespace

const Command& find_known_command(const std::string& name) {
  std::vector<std::string> names;
  for (const Command& command : commands()) {
    if (command.name == name) return command;
    names.emplace_back(command.name);
  }
  const std::string nearest = nearest_word(name, names);
  throw UsageError("unknown command '" + name + "'",
                   nearest.empty() ? "'fusee --help' lists the commands" : "did you mean 'fusee " + nearest + "'?");
}

const std::vector<Command>& commands() {
  static const std::vector<Command> all = {
      new_command(),        explain_command(),  analyze_command(),   build_command(),     check_command(),
      rewind_command(),     optimize_command(), reproduce_command(), calibrate_command(), compare_command(),
      plan_command(),       kit_command(),      model_command(),     simulate_command(),  replay_command(),
      completion_command(), manual_command()};
  return all;
}

CommandOutcome run_command(const std::vector<std::string>& words, Console& console, RunContext context) {
  CommandOutcome outcome;
  context.progress = [&console](std::string_view step, std::optional<double> share) { console.progress(step, share); };
  outcome.reply = dispatch_safely(words, outcome.command, console, context);
  outcome.json = has_switch(words, "--json");
  return outcome;
}

namespace {

/// Reports that no bundle was written. The exit code of a failed run has precedence.
void report_missing_bundle(const OutputError& error, Reply& reply) {
  reply.diagnostics.push_back(make_diagnostic(Severity::error, error.what(), error.hint()));
  if (reply.exit == Exit::done) reply.exit = Exit::cannot_write;
}

/// The files of a command. Once they are published, a signal has no effect.
class CommandFiles : public FileAccess {
 public:
  void will_publish(const std::filesystem::path&, const std::filesystem::path&) override { prevent_exit_by_signal(); }
};

CommandOutcome run_recorded(const std::vector<std::string>& words, const std::string& bundle, Console& console,
                            const std::stop_token& stop) {
  CommandOutcome outcome;
  outcome.json = has_switch(words, "--json");
  try {
    Recording recording(bundle, words, has_switch(words, "--force"));
    outcome = run_command(words, console, {.stop = stop, .files = &recording});
    outcome.reply.diagnostics.push_back(recording.pack(outcome));
    outcome.reply.fields["bundle"] = bundle;
  } catch (const OutputError& error) {
    report_missing_bundle(error, outcome.reply);
  } catch (const std::bad_alloc&) {
    report_missing_bundle(OutputError("no bundle was written: not enough memory"), outcome.reply);
  }
  return outcome;
}

}  // namespace

int run(const std::vector<std::string>& given) {
  std::vector<std::string> words = given;
  write_json_at_exit(has_switch(words, "--json"));
  catch_lack_of_memory();
  Console console;
  const std::string bundle = take_bundle_option(words);
  const auto run_watched = [&] {
    const SignalWatch watch;  // its destructor exits after a signal, before anything is printed
    CommandFiles files;
    return bundle.empty() ? run_command(words, console, {.stop = watch.stop(), .files = &files})
                          : run_recorded(words, bundle, console, watch.stop());
  };
  const CommandOutcome outcome = run_watched();
  const Reply& reply = outcome.reply;
  for (const Diagnostic& diagnostic : reply.diagnostics) console.report(diagnostic);
  console.end_progress();
  if (!write_result(outcome.result())) {
    console.report(make_diagnostic(Severity::error,
                                   std::string("the result could not be written to stdout: ") + std::strerror(errno)));
    return static_cast<int>(reply.exit == Exit::done ? Exit::cannot_write : reply.exit);
  }
  return static_cast<int>(reply.exit);
}

}  // namespace fusee::cli
