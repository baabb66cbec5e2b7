#include <algorithm>

#include "cli/command.h"
#include "cli/help.h"

namespace fusee::cli {
namespace {

/// Escapes a line so that troff takes it for text, and "-" for the character to type.
std::string plain(std::string_view line) {
  std::string text = line.rfind('.', 0) == 0 || line.rfind('\'', 0) == 0 ? "\\&" : "";
  for (const char c : line) {
    if (c == '\\')
      text += "\\e";
    else if (c == '-')
      text += "\\-";
    else
      text += c;
  }
  return text;
}

std::string upper(std::string_view words) {
  std::string text(words);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c; });
  return text;
}

std::string heading(std::string_view page, std::string_view summary) {
  return ".TH " + upper(page) + " 1 \"\" \"fusee " FUSEE_VERSION "\"\n.SH NAME\n" + plain(page) + " \\- " +
         plain(summary) + "\n";
}

std::string options_text(const std::vector<Option>& options) {
  std::string text;
  for (const Option& option : options) {
    std::string flags;
    for (const std::string& flag : split(option.flags, ','))
      flags += (flags.empty() ? "\\fB" : ", \\fB") + plain(flag) + "\\fR";
    text += ".TP\n" + flags + (option.value.empty() ? "" : " \\fI" + plain(option.value) + "\\fR") + "\n";
    for (const std::string& line : split(option.meaning, '\n')) text += plain(line) + "\n";
  }
  return text;
}

std::string page_of(const Command& command) {
  const std::string name(command.name);
  std::string text = heading("fusee-" + name, command.summary);
  const std::string arguments = synopsis(command).substr(name.size());  // after the blank, if there are any
  text += ".SH SYNOPSIS\n.B fusee " + name + "\n" +
          plain(arguments.substr(std::min<std::size_t>(1, arguments.size()))) + " [OPTIONS]\n.SH DESCRIPTION\n";
  for (const std::string& line : split(command.description, '\n')) text += plain(line) + "\n";
  if (!command.options.empty()) text += ".SH OPTIONS\n" + options_text(command.options);
  text += ".SH OPTIONS OF EVERY COMMAND\n" + options_text(common_options()) + ".SH EXAMPLES\n";
  for (const Example& example : command.examples)
    text += ".TP\n\\fB" + plain(example.line) + "\\fR\n" + plain(example.effect) + "\n";
  return text + ".SH SEE ALSO\n.BR fusee (1)\n";
}

std::string main_page() {
  std::string text =
      heading("fusee", "from a tendon-driven joint to the pulley that drives it, checked and ready to print or cut");
  text += ".SH SYNOPSIS\n.B fusee\nCOMMAND [ARGUMENTS] [OPTIONS]\n.SH COMMANDS\n";
  for (const Command& command : commands())
    text += ".TP\n.BR fusee\\-" + std::string(command.name) + " (1)\n" + plain(command.summary) + "\n";
  text += ".SH OPTIONS OF EVERY COMMAND\n" + options_text(common_options());
  text += ".SH EXIT STATUS\n";
  for (const ExitWords& one : exit_words())
    text += ".TP\n" + std::to_string(static_cast<int>(one.exit)) + "\n" + plain(one.words) + "\n";
  return text;
}

Reply run_manual(const Arguments& arguments, Console&, const RunContext&) {
  Reply reply;
  if (arguments.positionals().empty()) {
    reply.text = main_page();
  } else {
    reply.text = page_of(find_known_command(arguments.positionals().front()));
  }
  reply.fields["page"] = reply.text;
  return reply;
}

}  // namespace

Command manual_command() {
  return {"manual",
          "[COMMAND]",
          "a manual page for man(1), with the texts of --help",
          "Prints the manual page of COMMAND, or of fusee, as troff source.\n"
          "'cmake --install' installs all of them for man.",
          {},
          {{"fusee manual build > fusee-build.1", "for 'man ./fusee-build.1'"},
           {"fusee manual > fusee.1", "the page of the program itself"}},
          run_manual};
}

}  // namespace fusee::cli
