#include "base/text.h"
#include "cli/command.h"
#include "cli/questions.h"
#include "fusee/mechanism_file.h"
#include "mechanism/linear_relation.h"

namespace fusee::cli {
namespace {

Reply list_templates() {
  Reply reply;
  reply.fields["templates"] = Json::array();
  for (const Template& known : templates()) {
    const std::string about = first_comment(known);
    reply.text += std::string(known.name) + "\n" + (about.empty() ? "" : wrapped(about, "    ", "    "));
    reply.fields["templates"].push_back({{"name", known.name}, {"about", about}});
  }
  reply.text += "\n'fusee new TEMPLATE > my.toml' writes one of them.\n";
  return reply;
}

/// The mechanism with its lengths in the unit that a setting names; unchanged for an unknown one. Throws InputError for
/// a relation of [optimize] with a length as a plain number.
DeclaredMechanism in_units(DeclaredMechanism mechanism, std::string unit, const std::string& name) {
  std::erase(unit, '"');
  if (unit != "mm" && unit != "inch") return mechanism;
  const LengthUnit units = unit == "inch" ? LengthUnit::inch : LengthUnit::mm;
  for (const auto* relations : {&mechanism.optimize.tied, &mechanism.optimize.constraints}) {
    for (const std::string& relation : *relations) {
      if (units != mechanism.units && depends_on_units(relation))
        throw InputError(name, "the relation \"" + relation + "\" of [optimize] has a length as a plain number",
                         "convert that number by hand");
    }
  }
  mechanism.units = units;
  return mechanism;
}

/// The file with settings, and every key. A setting of `units` converts the file's lengths; others are in those units.
std::string with_settings(const std::string& text, const std::string& name, const std::vector<Setting>& settings,
                          std::vector<Diagnostic>& warnings, FileAccess& files) {
  std::string converted = text;
  for (const Setting& setting : settings) {
    if (setting.key != "units") continue;
    const DeclaredMechanism read = parse_mechanism(text, name, ".", {}, nullptr, nullptr, files);
    converted = write_mechanism(in_units(read, setting.value, name));
  }
  return write_mechanism(parse_mechanism(converted, name, ".", settings, &warnings, nullptr, files));
}

/// Writes the file of the answers, and reports if a pulley is feasible or which obstacles remain.
Reply ask_questions(const Arguments& arguments, Console& console, FileAccess& files) {
  if (!arguments.positionals().empty()) throw UsageError("--ask takes no template: it asks for the joint");
  if (files.is_bundled())
    throw UsageError("--ask reads typed answers, which a bundle cannot record",
                     "use --bundle with the file that it writes");
  const AskedMechanism asked = ask_for_mechanism(console);
  Reply reply;
  reply.text = asked.text;
  if (const auto settings = arguments.settings(); !settings.empty())
    reply.text = with_settings(reply.text, "your answers", settings, reply.diagnostics, files);
  for (const std::string& change : asked.changed)
    reply.diagnostics.push_back(note(Severity::note, "changed to make a pulley feasible: " + change));
  for (const profile::Condition& condition : asked.obstacles)
    reply.diagnostics.push_back(note(Severity::warning, "no pulley yet: " + condition.message));
  if (!asked.obstacles.empty())
    add_advice(asked.advice, reply);
  else
    reply.diagnostics.push_back(
        note(Severity::note, "a pulley is feasible: save this file, then run 'fusee build' on it"));
  reply.fields["text"] = reply.text;
  return reply;
}

Reply run_new(const Arguments& arguments, Console& console, const RunContext& context) {
  if (arguments.has("--ask")) return ask_questions(arguments, console, *context.files);
  if (arguments.positionals().empty()) return list_templates();
  const std::string& name = arguments.positionals().front();
  Reply reply;
  reply.text = find_template(name);
  if (const auto settings = arguments.settings(); !settings.empty())
    reply.text = with_settings(reply.text, name, settings, reply.diagnostics, *context.files);
  reply.fields["template"] = name;
  reply.fields["text"] = reply.text;
  return reply;
}

}  // namespace

Command new_command() {
  return {"new",
          "[TEMPLATE]",
          "a commented mechanism file, from a template or your answers",
          "Prints a mechanism file with an explanation of every number.\n"
          "Without TEMPLATE it lists the templates. With --ask it asks six questions and\n"
          "writes a file for which a pulley is feasible.",
          {{"--ask", "", "ask for the joint's numbers, each with a default"}},
          {{"fusee new", "list the templates"},
           {"fusee new paper_optimum > arm.toml", "save one as arm.toml"},
           {"fusee new --ask > arm.toml", "answer six questions; Enter takes the proposal"},
           {"fusee new paper_optimum --set pulley.r1_mm=15 > arm.toml", "the same with another r1"}},
          run_new};
}

}  // namespace fusee::cli
