#include <fmt/format.h>

#include <filesystem>

#include "base/text.h"
#include "cli/command.h"
#include "cli/questions.h"
#include "export/mesh_files/mesh_files.h"
#include "fusee/analysis.h"
#include "fusee/mechanism_file.h"
#include "mechanism/catalogue.h"
#include "mechanism/embedded.h"
#include "mechanism/lengths.h"
#include "mechanism/linear_relation.h"

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
      "\n'fusee new TEMPLATE > my.toml' writes one of them.\n'fusee new --ask > my.toml' asks for your joint.\n";
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

/// The torque that the motor has to hold, and whether the catalogue has a motor of that shaft or horn that does.
Diagnostic motor_note(const pipeline::ChosenLayout& layout) {
  Mechanism joint = layout.built.product.joint.mechanism;
  joint.motor = {};
  joint.motor.enforce = true;  // compares the models of the catalogue, without limits
  const analysis::MotorCheck motor = *analysis::under_load(joint).motor;
  const std::string words = fmt::format("under the load the motor has to hold {} Nmm", rounded(motor.torque.value, 3));
  const std::string strongest = motor.strongest_text();
  if (strongest.empty()) return make_diagnostic(Severity::note, words + ": " + motor.models_text());
  return make_diagnostic(Severity::warning, words + ": " + strongest,
                         "take a smaller load, or another motor; " + motor.models_text());
}

std::string other_answer_words(const OtherAnswer& other) {
  return fmt::format("try {} in place of {} for question {} ({})", other.answer, other.given, other.question,
                     other.words);
}

/// The torque that the motor of the answers has to hold, with its margin. A motor that is too weak has a warning.
Diagnostic margin_note(const analysis::MotorCheck& motor) {
  std::string words = fmt::format("under the load the motor has to hold {} Nmm, and {} {} {} Nmm",
                                  rounded(motor.torque.value, 3), motor.model.empty() ? "it" : motor.model,
                                  motor.holds ? "holds" : "stalls at", rounded(motor.torque_limit, 3));
  if (motor.torque.value > 0)
    words += fmt::format(" (margin {}; {} is advised)", rounded(motor.torque_limit / motor.torque.value, 3),
                         rounded(motor.holds ? 1.0 : k_advised_stall_margin));
  return make_diagnostic(Severity::note, words);
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
    reply.diagnostics.push_back(make_diagnostic(
        Severity::error, "no layout fits these answers: " + lengths_in(asked.units, asked.search.obstacle),
        "no file was written"));
    reply.fields["other_answers"] = Json::array();
    for (const OtherAnswer& other : asked.others) {
      reply.diagnostics.push_back(make_diagnostic(Severity::note, lengths_in(asked.units, other_answer_words(other))));
      reply.fields["other_answers"].push_back(
          {{"question", other.question}, {"subject", other.words}, {"answer", other.answer}, {"given", other.given}});
    }
    if (asked.others.empty())
      reply.diagnostics.push_back(make_diagnostic(Severity::note, "no change of a single answer was found that helps"));
    return reply;
  }
  const pipeline::ChosenLayout& layout = *asked.search.chosen;
  const formats::Product& product = layout.built.product;
  reply.text = asked.text;
  reply.diagnostics = product.file.warnings;
  for (Diagnostic& diagnostic : reply.diagnostics) {
    diagnostic.message = lengths_in(asked.units, diagnostic.message);
    diagnostic.hint = lengths_in(asked.units, diagnostic.hint);
  }
  for (const std::vector<std::string>* warnings : {&product.synthesis.warnings, &product.holding.warnings}) {
    for (const std::string& warning : *warnings)
      reply.diagnostics.push_back(make_diagnostic(Severity::warning, warning));
  }
  reply.diagnostics.push_back(make_diagnostic(
      Severity::note, fmt::format("{}: built and checked ({} checks), {} {} wide, turns {} deg", layout.words,
                                  product.checks.size(), rounded(from_mm(layout.diameter, asked.units), 3),
                                  unit_word(asked.units), rounded(degrees(layout.travel), 3))));
  if (!layout.pretension_words.empty()) {
    const bool is_taut = product.under_load.slack1.empty() && product.under_load.slack2.empty();
    reply.diagnostics.push_back(
        is_taut ? make_diagnostic(Severity::note, fmt::format("tendon.pretension_N = {}: {}",
                                                              rounded(layout.file.mechanism.tendon.pretension),
                                                              layout.pretension_words))
                : make_diagnostic(Severity::warning, "a tendon is slack under the load: " + layout.pretension_words));
  }
  if (!layout.price_words.empty())
    reply.diagnostics.push_back(
        make_diagnostic(layout.is_held ? Severity::note : Severity::warning, layout.price_words));
  if (asked.room)
    reply.diagnostics.push_back(
        make_diagnostic(Severity::note, lengths_in(asked.units, "the motor holds the load with " + asked.room_words +
                                                                    ": " + other_answer_words(*asked.room))));
  if (!product.file.mechanism.motor.is_there())
    reply.diagnostics.push_back(motor_note(layout));
  else if (const auto& motor = product.under_load.motor; motor && motor->torque_limit >= motor->torque.value)
    reply.diagnostics.push_back(margin_note(*motor));
  reply.diagnostics.push_back(make_diagnostic(Severity::note, "save this file, then run 'fusee build' on it"));
  reply.fields["text"] = reply.text;
  reply.fields["layout"] = layout.words;
  reply.fields["pulley_diameter_mm"] = layout.diameter;
  reply.fields["pulley_travel_deg"] = degrees(layout.travel);
  return reply;
}

constexpr std::size_t k_largest_print = std::size_t{512} << 20;

/// The law's table of a kept mechanism. Nothing else is read, as the file may come from anywhere.
class KeptTable : public FileAccess {
 public:
  KeptTable(std::string file, const std::optional<std::string>& table) : file_(std::move(file)), table_(table) {}

  void read(const ReadRequest& request, const TakeBlock& take) override {
    const std::string name = request.path.filename().string();
    if (!table_ || request.path != name)
      throw InputError(file_, "its mechanism needs '" + request.path.string() + "', which it does not keep");
    if (table_->size() > request.limit) throw InputError(file_, "its table is too large");
    name_ = name;
    if (!table_->empty()) take(*table_);
  }
  /// Name of the table, once it was read; empty if the law has none.
  const std::string& name() const { return name_; }

 private:
  std::string file_;
  const std::optional<std::string>& table_;
  std::string name_;
};

/// The mechanism file that `fusee build` kept in a 3MF.
Reply open_print(const Arguments& arguments, FileAccess& files) {
  if (!arguments.positionals().empty()) throw UsageError("--from takes no template: it reads the file's own mechanism");
  const std::filesystem::path print = *arguments.text("--from");
  const formats::KeptMechanism kept =
      formats::read_kept_mechanism(read_file(print, k_largest_print, files), print.string());
  Reply reply;
  KeptTable table(print.string(), kept.table);
  const auto settings = arguments.settings();
  const DeclaredMechanism mechanism =
      parse_mechanism(kept.text, print.string(), "", settings, &reply.diagnostics, nullptr, table);
  reply.text = settings.empty() ? kept.text : write_mechanism(mechanism);
  reply.fields["from"] = print.string();
  reply.fields["text"] = reply.text;
  if (!table.name().empty()) {
    reply.fields["table"] = {{"file", table.name()}, {"text", *kept.table}};
    if (!arguments.has("--out"))
      reply.diagnostics.push_back(make_diagnostic(
          Severity::warning, "its law needs the table " + table.name() + " beside it", "-o FILE.toml writes both"));
  }
  return reply;
}

/// Files on the disk, and a template's table where there is none of its name.
class TemplateFiles : public FileAccess {
 public:
  TemplateFiles(const std::optional<TemplateTable>& table, FileAccess& files) : table_(table), files_(files) {}

  void read(const ReadRequest& request, const TakeBlock& take) override {
    const bool is_of_template = table_ && request.path.filename() == table_->file;
    if (is_of_template && (files_.is_bundled() || !std::filesystem::exists(request.path)))
      take(table_->text);
    else
      files_.read(request, take);
  }
  bool is_bundled() const override { return files_.is_bundled(); }

 private:
  const std::optional<TemplateTable>& table_;
  FileAccess& files_;
};

/// Writes the file of -o, and the table of its law beside it.
void write_new_file(const Arguments& arguments, FileAccess& files, Reply& reply) {
  const std::filesystem::path path = *arguments.text("--out");
  const bool force = arguments.has("--force");
  if (!arguments.has("--dry-run")) {
    // An existing file is refused before its table is written, and an existing table before its file.
    const bool exists = std::filesystem::exists(path);
    if (exists) write_file(path, reply.text, force, files);
    if (reply.fields.contains("table")) {
      const auto& table = reply.fields["table"];
      write_file(path.parent_path() / table["file"].get<std::string>(), table["text"].get<std::string>(), force, files);
    }
    if (!exists) write_file(path, reply.text, force, files);
  }
  reply.fields["file"] = path.string();
  reply.text = arguments.has("--dry-run") ? "no file written (--dry-run)\n" : path.string() + "\n";
}

Reply template_or_list(const Arguments& arguments, FileAccess& files) {
  if (arguments.positionals().empty()) return list_templates();
  const std::string& name = arguments.positionals().front();
  Reply reply;
  reply.text = find_template(name);
  std::optional<TemplateTable> table;
  for (TemplateTable& known : template_tables())
    if (known.template_name == name) table = std::move(known);
  if (const auto settings = arguments.settings(); !settings.empty()) {
    TemplateFiles with_table(table, files);
    reply.text = with_settings(reply.text, name, settings, reply.diagnostics, with_table);
  }
  if (table && reply.text.find('"' + table->file + '"') != std::string::npos) {
    reply.fields["table"] = {{"file", table->file}, {"text", table->text}};
    if (!arguments.has("--out"))
      reply.diagnostics.push_back(make_diagnostic(Severity::note,
                                                  fmt::format("its law needs the table {} beside it", table->file),
                                                  fmt::format("'fusee new {0} -o {0}.toml' writes both", name)));
  }
  reply.fields["template"] = name;
  reply.fields["text"] = reply.text;
  return reply;
}

Reply run_new(const Arguments& arguments, Console& console, const RunContext& context) {
  const bool asks = arguments.has("--ask"), opens = arguments.has("--from");
  if (asks && opens) throw UsageError("--ask and --from exclude each other");
  Reply reply = asks    ? ask_questions(arguments, console, context)
                : opens ? open_print(arguments, *context.files)
                        : template_or_list(arguments, *context.files);
  if (!arguments.has("--out")) return reply;
  if (!reply.fields.contains("text")) throw UsageError("-o needs a TEMPLATE, --from or --ask");
  write_new_file(arguments, *context.files, reply);
  return reply;
}

}  // namespace

Command new_command() {
  return {"new",
          "[TEMPLATE]",
          "a commented mechanism file to start from",
          "Prints a mechanism file with an explanation of every number.\n"
          "Without TEMPLATE it lists the templates. With --ask it asks seven questions,\n"
          "chooses the layout by full builds, draws the joint and writes its file.\n"
          "With --from it prints the file that fusee build kept in a 3MF: building it\n"
          "gives the same meshes.",
          {{"--ask", "", "ask for the joint's numbers, each with a default"},
           {"--from", "PRINT.3mf", "the mechanism file of a print that fusee made"},
           {"-o,--out", "FILE", "write FILE, and the table of its law beside it"}},
          {{"fusee new", "list the templates"},
           {"fusee new paper_optimum > arm.toml", "save one as arm.toml"},
           {"fusee new --ask > arm.toml", "answer seven questions; Enter takes the proposal"},
           {"fusee new --from pulley.3mf -o earlier.toml", "the mechanism file of an earlier print"},
           {"fusee new paper_optimum --set pulley.r1_mm=17 > arm.toml", "the same with another r1"}},
          run_new};
}

}  // namespace fusee::cli
