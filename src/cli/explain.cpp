#include "cli/command.h"
#include "fusee/mechanism_file.h"

namespace fusee::cli {
namespace {

Reply run_explain(const Arguments& arguments, Console&, const RunContext&) {
  Reply reply;
  if (arguments.has("--schema")) {
    const std::string schema = mechanism_schema();
    reply.text = schema;
    reply.fields["json_schema"] = parse_json(schema);
    return reply;
  }
  const std::string key = arguments.positionals().empty() ? "" : arguments.positionals().front();
  reply.text = explain(key);
  reply.fields["explained"] = parse_json(explain_json(key));
  return reply;
}

}  // namespace

Command explain_command() {
  return {"explain",
          "[KEY]",
          "meaning of a key of the mechanism file",
          "Explains a key of the mechanism file: meaning, unit, range and\n"
          "default. KEY is a key (r1_mm), a key with its table (pulley.r1_mm) or a table\n"
          "(pulley). Without KEY it lists them all.",
          {{"--schema", "", "the JSON schema of the mechanism file, for editors"}},
          {{"fusee explain", "list all keys"},
           {"fusee explain pulley.r1_mm", "one key"},
           {"fusee explain --schema > mechanism.schema.json", "completion and checking in an editor"}},
          run_explain};
}

}  // namespace fusee::cli
