#include "cli/reply.h"

#include <algorithm>

#include "base/text.h"
#include "mechanism/lengths.h"

namespace fusee::cli {
namespace {

Json diagnostic_json(const Diagnostic& diagnostic) {
  return {{"file", diagnostic.place.file},
          {"line", diagnostic.place.line},
          {"column", diagnostic.place.column},
          {"message", diagnostic.message},
          {"hint", diagnostic.hint}};
}

/// The errors, or all diagnostics that are no errors.
Json diagnostics_json(const std::vector<Diagnostic>& diagnostics, bool errors) {
  Json list = Json::array();
  for (const Diagnostic& diagnostic : diagnostics) {
    if ((diagnostic.severity == Severity::error) == errors) list.push_back(diagnostic_json(diagnostic));
  }
  return list;
}

}  // namespace

void convert_to_file_units(Reply& reply) {
  reply.text = lengths_in(reply.units, reply.text);
  for (Diagnostic& diagnostic : reply.diagnostics) {
    diagnostic.message = lengths_in(reply.units, diagnostic.message);
    diagnostic.hint = lengths_in(reply.units, diagnostic.hint);
  }
}

std::string document(const Reply& reply, const std::string& command) {
  Json json = {
      {"schema", 1}, {"command", command}, {"ok", reply.exit == Exit::done}, {"exit", static_cast<int>(reply.exit)}};
  json["errors"] = diagnostics_json(reply.diagnostics, /*errors=*/true);
  json["warnings"] = diagnostics_json(reply.diagnostics, /*errors=*/false);
  json.update(reply.fields);
  return json_text(json, 2);
}

Json to_json(const Check& check) {
  return {{"name", check.name}, {"value", check.value}, {"limit", check.limit},
          {"unit", check.unit}, {"ok", check.ok},       {"where", check.where}};
}

Json to_json(const std::vector<Check>& checks) {
  Json list = Json::array();
  for (const Check& check : checks) list.push_back(to_json(check));
  return list;
}

Json to_json(const std::vector<profile::Condition>& conditions) {
  Json list = Json::array();
  for (const profile::Condition& condition : conditions) {
    list.push_back({{"name", condition.name},
                    {"ok", condition.ok},
                    {"alpha_deg", degrees(condition.alpha)},
                    {"value", condition.value},
                    {"limit", condition.limit},
                    {"unit", condition.unit},
                    {"message", condition.message}});
  }
  return list;
}

Json to_json(const std::vector<profile::Change>& advice) {
  Json list = Json::array();
  for (const profile::Change& change : advice) {
    Json entry{
        {"key", change.key}, {"from", change.from}, {"to", change.to}, {"unit", change.unit}, {"text", change.text}};
    if (change.until) entry["until"] = *change.until;
    if (!change.to_word.empty()) {
      entry["from"] = change.from_word;
      entry["to"] = change.to_word;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

void add_obstacles(const std::string& file, const std::vector<profile::Condition>& conditions, Reply& reply) {
  for (const profile::Condition& condition : conditions) {
    if (!condition.ok) reply.diagnostics.push_back(about_file(Severity::error, file, condition.message));
  }
}

void add_advice(const std::string& file, const std::vector<profile::Change>& advice, Reply& reply, bool is_exhausted) {
  for (const profile::Change& change : advice)
    reply.diagnostics.push_back(about_file(Severity::note, file, "try " + profile::setting_words(change)));
  const auto is_number = [](const profile::Change& change) { return change.to_word.empty(); };
  if (std::none_of(advice.begin(), advice.end(), is_number))
    reply.diagnostics.push_back(
        about_file(Severity::note, file,
                   (advice.empty() ? "" : "besides this, ") +
                       std::string(is_exhausted ? "no change of a single number makes it feasible"
                                                : "no change of a single number was found that makes "
                                                  "it feasible")));
}

void add_layout_advice(const std::string& file, const std::optional<profile::LayoutAdvice>& advice, Reply& reply) {
  if (!advice) return;
  std::string lines;
  Json settings = Json::array();
  for (const auto& [key, value] : advice->settings) {
    lines += (lines.empty() ? "" : "\n        ") + key + " = " + value;
    settings.push_back({{"key", key}, {"value", value}});
  }
  reply.diagnostics.push_back(about_file(
      Severity::note, file, "or " + advice->text + " ('fusee new " + advice->template_name + "' shows one)", lines));
  reply.fields["advice_layout"] = {
      {"text", advice->text}, {"template", advice->template_name}, {"settings", std::move(settings)}};
}

void add_advice_together(const std::string& file, const std::vector<profile::Change>& advice, Reply& reply) {
  if (advice.empty()) return;
  std::string changes;
  for (const profile::Change& change : advice)
    changes += (changes.empty() ? "" : " together with ") + profile::setting_words(change);
  reply.diagnostics.push_back(about_file(Severity::note, file, "try " + changes));
}

void explain_without_law(const std::string& file, const profile::SynthesisResult& without_law, Reply& reply) {
  reply.exit = Exit::infeasible;
  add_obstacles(file, without_law.conditions, reply);
  add_advice(file, without_law.advice, reply);
}

Diagnostic make_diagnostic(Severity severity, std::string message, std::string hint) {
  Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.message = std::move(message);
  diagnostic.hint = std::move(hint);
  return diagnostic;
}

Diagnostic about_file(Severity severity, std::string file, std::string message, std::string hint) {
  Diagnostic diagnostic = make_diagnostic(severity, std::move(message), std::move(hint));
  diagnostic.place.file = std::move(file);
  return diagnostic;
}

void add_log_notes(const std::vector<measurement::Run>& runs, const std::vector<std::string>& notes, Reply& reply) {
  for (const std::string& words : notes) {
    std::size_t name_end = 0;
    for (const measurement::Run& run : runs) {
      if (words.starts_with(run.name)) name_end = std::max(name_end, words.find(": ", run.name.size()));
    }
    reply.diagnostics.push_back(
        name_end == 0 || name_end == std::string::npos
            ? make_diagnostic(Severity::note, words)
            : about_file(Severity::note, words.substr(0, name_end), words.substr(name_end + 2)));
  }
}

}  // namespace fusee::cli
