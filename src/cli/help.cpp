#include "cli/help.h"

#include <algorithm>

#include "base/text.h"

namespace fusee::cli {
namespace {

constexpr std::size_t k_meaning_column = 26;

/// "  -o, --out DIR           where the files go"; further lines are aligned with the first.
std::string option_line(const Option& option) {
  std::string flags(option.flags);
  if (const std::size_t comma = flags.find(','); comma != std::string::npos) flags.insert(comma + 1, " ");
  std::string line = (flags.rfind("--", 0) == 0 ? "      " : "  ") + flags;
  if (!option.value.empty()) line += " " + std::string(option.value);
  if (characters(line) + 2 > k_meaning_column) line += "\n" + std::string(k_meaning_column, ' ');
  if (const std::size_t width = characters(line); width < k_meaning_column) line.append(k_meaning_column - width, ' ');
  for (const char c : option.meaning) line += c == '\n' ? "\n" + std::string(k_meaning_column, ' ') : std::string(1, c);
  return line + "\n";
}

std::string option_lines(const std::vector<Option>& options) {
  std::string text;
  for (const Option& option : options) text += option_line(option);
  return text;
}

}  // namespace

const std::vector<ExitWords>& exit_words() {
  static const std::vector<ExitWords> all = {
      {Exit::done, "done"},
      {Exit::bug, "a bug in fusee"},
      {Exit::usage, "wrong usage"},
      {Exit::bad_input, "bad input"},
      {Exit::infeasible, "the pulley is infeasible"},
      {Exit::check_failed, "built, but a check failed"},
      {Exit::cannot_write, "an output exists or cannot be written; out of memory"},
      {Exit::interrupted, "interrupted"}};
  return all;
}

std::string main_help() {
  std::string text =
      "fusee: from a tendon-driven joint to the pulley that drives it, checked and\n"
      "ready to print or cut.\n"
      "\n"
      "usage: fusee COMMAND [ARGUMENTS] [OPTIONS]\n"
      "\n"
      "commands:\n";
  for (const Command& command : commands()) {
    std::string line = "  " + std::string(command.name) + " " + std::string(command.positionals);
    line.resize(std::max(line.size() + 2, k_meaning_column), ' ');
    text += line + std::string(command.summary) + "\n";
  }
  text += "\noptions, before or after the command:\n" + option_lines(common_options());
  text +=
      "\n"
      "examples:\n"
      "  fusee new paper_optimum > arm.toml   a mechanism file to start from\n"
      "  fusee build arm.toml                 the pulley and its report, in out/arm\n"
      "  fusee explain pulley.r1_mm           the meaning of a key of that file\n"
      "\n"
      "exit codes:\n";
  for (const ExitWords& one : exit_words()) {
    std::string code = std::to_string(static_cast<int>(one.exit));
    code.resize(5, ' ');
    text += "  " + code + std::string(one.words) + "\n";
  }
  text += "\n'fusee help COMMAND' describes a command, with examples.\n";
  return text;
}

std::string synopsis(const Command& command) {
  std::string text(command.name);
  for (const std::string_view part : {command.positionals, command.required_options})
    text += (part.empty() ? "" : " ") + std::string(part);
  return text;
}

std::string command_help(const Command& command) {
  std::string text = "usage: fusee " + synopsis(command) + " [OPTIONS]\n\n";
  text += std::string(command.description) + "\n";
  if (command.positionals.find("SPEC") != std::string_view::npos)
    text += "SPEC is a mechanism file; 'fusee new' prints one.\n";
  text += "\nexamples:\n";
  for (const Example& example : command.examples) {
    text += "  " + std::string(example.line) + "\n      " + std::string(example.effect) + "\n";
  }
  if (!command.options.empty()) text += "\noptions of this command:\n" + option_lines(command.options);
  return text + "\noptions of every command:\n" + option_lines(common_options());
}

}  // namespace fusee::cli
