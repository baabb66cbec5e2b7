#include <fmt/format.h>

#include "base/text.h"
#include "cli/command.h"
#include "cli/questions.h"
#include "fusee/mechanism_file.h"

namespace fusee::cli {
namespace {

Reply list_templates() {
  Reply reply;
  reply.fields["templates"] = Json::array();
  std::string group;
  for (const Template& known : templates()) {
    if (known.group != group) reply.text += (group.empty() ? "" : "\n") + known.group + "\n";
    group = known.group;
    reply.text += fmt::format("  {:<13} {}\n", known.name, known.description);
    reply.fields["templates"].push_back({{"name", known.name}, {"group", known.group}, {"about", known.description}});
  }
  reply.text +=
      "\n'fusee new TEMPLATE > my.toml' writes one of them; 'fusee new --ask > my.toml' asks for your joint.\n";
  return reply;
}

/// The file of the answers, or why no layout fits them and which other answers would do.
Reply ask_questions(const Arguments& arguments, Console& console, const RunContext& context) {
  if (!arguments.positionals().empty()) throw UsageError("--ask takes no template: it asks for the joint");
  if (context.files->is_bundled())
    throw UsageError("--ask reads typed answers, which a bundle cannot record",
                     "use --bundle with the file that it writes");
  const AskedMechanism asked = ask_for_mechanism(console, arguments.settings(), context);
  Reply reply;
  if (!asked.search.chosen) {
    reply.exit = Exit::infeasible;
    reply.diagnostics.push_back(
        note(Severity::error, "no layout fits these answers: " + asked.search.obstacle, "no file was written"));
    reply.fields["other_answers"] = Json::array();
    for (const OtherAnswer& other : asked.others) {
      reply.diagnostics.push_back(
          note(Severity::note, fmt::format("try {} in place of {} for question {} ({})", other.answer, other.given,
                                           other.question, other.words)));
      reply.fields["other_answers"].push_back(
          {{"question", other.question}, {"subject", other.words}, {"answer", other.answer}, {"given", other.given}});
    }
    if (asked.others.empty())
      reply.diagnostics.push_back(note(Severity::note, "no change of a single answer was found that helps"));
    return reply;
  }
  const pipeline::ChosenLayout& layout = *asked.search.chosen;
  const formats::Product& product = layout.built.product;
  reply.text = asked.text;
  reply.diagnostics = product.file.warnings;
  for (const std::vector<std::string>* warnings : {&product.synthesis.warnings, &product.holding.warnings}) {
    for (const std::string& warning : *warnings) reply.diagnostics.push_back(note(Severity::warning, warning));
  }
  reply.diagnostics.push_back(
      note(Severity::note,
           fmt::format("{}: built and checked ({} checks), {} mm wide, turns {} deg", layout.words,
                       product.checks.size(), rounded(layout.diameter, 3), rounded(degrees(layout.travel), 3))));
  reply.diagnostics.push_back(note(Severity::note, "save this file, then run 'fusee build' on it"));
  reply.fields["text"] = reply.text;
  reply.fields["layout"] = layout.words;
  reply.fields["pulley_diameter_mm"] = layout.diameter;
  reply.fields["pulley_travel_deg"] = degrees(layout.travel);
  return reply;
}

Reply run_new(const Arguments& arguments, Console& console, const RunContext& context) {
  if (arguments.has("--ask")) return ask_questions(arguments, console, context);
  if (arguments.positionals().empty()) return list_templates();
  const std::string& name = arguments.positionals().front();
  Reply reply;
  reply.text = find_template(name);
  if (const auto settings = arguments.settings(); !settings.empty()) {
    reply.text =
        write_mechanism(parse_mechanism(reply.text, name, ".", settings, &reply.diagnostics, nullptr, *context.files));
  }
  reply.fields["template"] = name;
  reply.fields["text"] = reply.text;
  return reply;
}

}  // namespace

Command new_command() {
  return {"new",
          "[TEMPLATE]",
          "a commented mechanism file to start from",
          "Prints a mechanism file with an explanation of every number.\n"
          "Without TEMPLATE it lists the templates. With --ask it asks seven questions,\n"
          "chooses the layout by full builds, draws the joint and writes its file.",
          {{"--ask", "", "ask for the joint's numbers, each with a default"}},
          {{"fusee new", "list the templates"},
           {"fusee new paper_optimum > arm.toml", "save one as arm.toml"},
           {"fusee new --ask > arm.toml", "answer seven questions; Enter takes the proposal"},
           {"fusee new paper_optimum --set pulley.r1_mm=15 > arm.toml", "the same with another r1"}},
          run_new};
}

}  // namespace fusee::cli
