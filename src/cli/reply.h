/// \file
/// The reply of a command: exit code, text for a person, and JSON.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "fusee/base.h"
#include "fusee/measurement.h"
#include "fusee/mechanism.h"
#include "fusee/profile.h"

namespace fusee::cli {

enum class Exit {
  done = 0,
  bug = 1,
  usage = 2,
  bad_input = 3,
  infeasible = 4,
  check_failed = 5,
  cannot_write = 6,
  interrupted = 130
};

struct Reply {
  Exit exit = Exit::done;
  std::string text;                     ///< results, for stdout
  std::vector<Diagnostic> diagnostics;  ///< for stderr, and "errors" and "warnings" of the document
  Json fields = Json::object();         ///< JSON fields in addition to schema, ok, exit, errors and warnings
  LengthUnit units = LengthUnit::mm;    ///< of the mechanism file, for convert_to_file_units()
};

/// Converts lengths in text and messages from mm to the mechanism file's unit. JSON fields stay in mm, as named.
void convert_to_file_units(Reply& reply);

/// The JSON document of --json.
std::string document(const Reply& reply, const std::string& command);

Json to_json(const Check& check);
Json to_json(const std::vector<Check>& checks);
Json to_json(const std::vector<profile::Condition>& conditions);
Json to_json(const std::vector<profile::Change>& advice);

/// Adds an error for each failed condition.
void add_obstacles(const std::string& file, const std::vector<profile::Condition>& conditions, Reply& reply);
/// Adds a note for each change that would help. `is_exhausted`: every number was searched over its whole range.
void add_advice(const std::string& file, const std::vector<profile::Change>& advice, Reply& reply,
                bool is_exhausted = true);
/// Adds a note and the field "advice_layout" for another layout; nothing if there is none.
void add_layout_advice(const std::string& file, const std::optional<profile::LayoutAdvice>& advice, Reply& reply);
/// Adds a note for changes that only help together; nothing if there are none.
void add_advice_together(const std::string& file, const std::vector<profile::Change>& advice, Reply& reply);

/// Explains that a joint has no law θ(α): Exit::infeasible, conditions and advice.
void explain_without_law(const std::string& file, const profile::SynthesisResult& without_law, Reply& reply);

/// A diagnostic without a file. about_file() makes one for a whole file.
Diagnostic make_diagnostic(Severity severity, std::string message, std::string hint = {});
Diagnostic about_file(Severity severity, std::string file, std::string message, std::string hint = {});
/// Adds the notes about logs. A note about one log names it as its place: "run_1.csv: note: the header is line 4".
void add_log_notes(const std::vector<measurement::Run>& runs, const std::vector<std::string>& notes, Reply& reply);

}  // namespace fusee::cli
