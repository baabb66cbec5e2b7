#include "cli/command.h"
#include "fusee/mechanism/file.h"

namespace fusee::cli {
namespace {

Reply list_templates() {
  Reply reply;
  reply.fields["templates"] = Json::array();
  for (const Template& known : templates()) {
    const std::string about = first_comment(known);
    reply.text += std::string(known.name) + (about.empty() ? "" : "\n    " + about) + "\n";
    reply.fields["templates"].push_back({{"name", known.name}, {"about", about}});
  }
  reply.text += "\n'fusee new TEMPLATE > my.toml' writes one of them.\n";
  return reply;
}

Reply run_new(const Arguments& arguments, Console&) {
  if (arguments.positionals().empty()) return list_templates();
  const std::string& name = arguments.positionals().front();
  Reply reply;
  reply.text = find_template(name);
  if (const auto settings = arguments.settings(); !settings.empty()) {
    reply.text = write_mechanism(parse_mechanism(reply.text, name, ".", settings, &reply.diagnostics));
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
          "Prints a mechanism file with every number explained, to be saved and edited.\n"
          "Without TEMPLATE it lists the templates.",
          {},
          {{"fusee new", "list the templates"},
           {"fusee new paper_optimum > arm.toml", "save one as arm.toml"},
           {"fusee new paper_optimum --set pulley.r1_mm=15 > arm.toml", "the same with another r1"}},
          run_new};
}

}  // namespace fusee::cli
