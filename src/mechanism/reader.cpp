#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "mechanism/catalogue.h"
#include "mechanism/embedded.h"
#include "mechanism/field_text.h"
#include "mechanism/horn_faults.h"
#include "mechanism/law_table.h"
#include "mechanism/lengths.h"
#include "mechanism/nesting.h"
#include "mechanism/optimize_table.h"
#include "mechanism/written_number.h"

// Reads bytes into a DeclaredMechanism in four steps. Each continues after errors, so that all errors of a file are
// reported together:
// 1. toml++ parses the text; only a syntax error ends the reading.
// 2. The tree is flattened to "table.key" → node with its place, and --set values replace or add entries.
// 3. Each entry is checked against its row of the field table; missing mandatory keys are reported.
// 4. Keys are checked against each other, and the CSV of law = "table" or "torque" is loaded.

namespace fusee {
namespace {

constexpr std::size_t k_max_file_size = 1 << 20;
constexpr std::size_t k_max_table_size = 8 << 20;
constexpr std::size_t k_max_text_length = 200;
constexpr std::size_t k_max_list_length = 100;
constexpr std::size_t k_max_errors = 100;
constexpr double k_min_length = 0.001;  // mm

Place place_of(const toml::source_region& region, const std::string& file) {
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

/// A value of the file or of --set, with its place.
struct Entry {
  const toml::node* node = nullptr;
  Place place;
};

/// A value as messages describe it: `the string "abc"`, "a table", "4".
std::string described(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "the string " + in_quotes(**node.as_string());
    case toml::node_type::integer:
      return "the number " + std::to_string(**node.as_integer());
    case toml::node_type::floating_point:
      return "the number " + shortest(**node.as_floating_point());
    case toml::node_type::boolean:
      return **node.as_boolean() ? "true" : "false";
    case toml::node_type::array:
      return "a list of " + std::to_string(node.as_array()->size());
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

/// The parser's description, which has escaped line feeds and tabs already. It may quote the file's bytes.
std::string syntax_error(std::string_view description) {
  // Strips the prefix of "Error while parsing key-value pair: expected …".
  const std::size_t colon = description.find(": ");
  if (description.starts_with("Error") && colon != std::string_view::npos) description.remove_prefix(colon + 2);
  std::string text = "not TOML: " + unicode_escaped(description.substr(0, k_max_text_length));
  constexpr std::string_view k_line_feed = "'\\n'";
  if (const std::size_t at = text.find(k_line_feed); at != std::string::npos)
    text.replace(at, k_line_feed.size(), "the end of the line");
  return text;
}

/// Advice for a line that is not TOML, such as `key = 17,0` or `key = word`.
std::string syntax_hint(std::string_view text, std::size_t line) {
  for (; line > 1 && !text.empty(); --line) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  text = text.substr(0, text.find('\n'));
  const std::size_t equals = text.find('=');
  std::string_view value = equals == std::string_view::npos ? std::string_view() : text.substr(equals + 1);
  value.remove_prefix(std::min(value.find_first_not_of(" \t"), value.size()));
  const std::size_t after_digits = value.find_first_not_of("+-0123456789");
  const bool comma = after_digits != std::string_view::npos && after_digits > 0 && value[after_digits] == ',';
  if (comma) {
    std::string number(value.substr(0, value.find_first_of(" \t\r#")));
    number[after_digits] = '.';
    return "a number has a decimal point: " + as_shown(number);
  }
  const bool word = !value.empty() && std::isalpha(static_cast<unsigned char>(value.front())) != 0;
  if (word) return "a text stands in quotes: " + in_quotes(value.substr(0, value.find_first_of(" \t\r#")));
  return "strings stand in quotes, lists in [ ], one key = value a line";
}

class MechanismReader {
 public:
  MechanismReader(const std::string& name, const std::filesystem::path& folder, FileAccess& files)
      : name_(name), folder_(folder), files_(files) {}

  DeclaredMechanism read(std::string_view text, const std::vector<Setting>& settings,
                         std::vector<Diagnostic>* warnings);
  KeyPlaces places() const;

 private:
  // Step 1 and 2
  void parse(std::string_view text);
  void flatten();
  void flatten_table(const std::string& table, const toml::table& node);
  void take_former_key(const FormerKey& former, const toml::table& table, const Entry& entry);
  void apply(const Setting& setting);
  toml::table setting_value(const Setting& setting, const std::string& file);
  // Step 3
  void take_pair_settings();
  void take(const Field& field, const Entry& entry);
  void take_number(const Field& field, const Entry& entry, int end, const toml::node& node);
  void fail_number(const Field& field, const Place& place, const toml::node& node);
  bool take_pair(const Field& field, const Entry& entry);
  void take_range(const Field& field, const Entry& entry);
  void demand_home(const Field& field, const Entry& entry, double lowest, double highest);
  bool demand_line(const Field& field, const Place& place, const std::string& text);
  void take_text(const Field& field, const Entry& entry);
  void take_numbers(const Field& field, const Entry& entry);
  void take_texts(const Field& field, const Entry& entry);
  void take_shaft();
  bool is_needed(const Field& field) const;
  void report_missing();
  // Step 4
  void check_transmission();
  void check_unused();
  void check_method();
  void check_torque_law();
  void check_drum();
  void check_idlers();
  void check_sheath();
  void check_horn();
  void check_motor();
  void check_optimize();
  void check_prior();
  void load_law_table();

  bool has(const std::string& key) const { return entries_.count(key) > 0; }
  bool has_table(const std::string& table) const;
  Place table_place(std::string_view table) const;
  void fail(const Place& place, std::string message, std::string hint = {});
  void warn(const Place& place, std::string message, std::string hint = {});
  void fail_unknown(const Place& place, const std::string& table, const std::string& key);
  void finish(std::vector<Diagnostic>* warnings);

  const std::string& name_;
  const std::filesystem::path& folder_;
  FileAccess& files_;
  toml::table root_;
  std::vector<std::unique_ptr<toml::table>> setting_values_;  ///< keeps the nodes of --set alive
  std::map<std::string, Entry> entries_;                      ///< by dotted name
  /// --set of one number of a pair, applied after the file's value or its default.
  std::vector<std::pair<NumberKey, Entry>> pair_settings_;
  std::map<std::string, Place> tables_;  ///< tables of the file
  std::vector<Diagnostic> errors_;
  std::vector<Diagnostic> table_errors_;  ///< errors of the CSV, reported after those of the file
  std::vector<Diagnostic> warnings_;
  std::map<std::string, bool> good_;  ///< by dotted name of a key that was read; false: with an error
  DeclaredMechanism mechanism_;
};

void MechanismReader::fail(const Place& place, std::string message, std::string hint) {
  errors_.push_back({Severity::error, place, std::move(message), std::move(hint)});
}

void MechanismReader::warn(const Place& place, std::string message, std::string hint) {
  warnings_.push_back({Severity::warning, place, std::move(message), std::move(hint)});
}

bool MechanismReader::has_table(const std::string& table) const {
  if (tables_.count(table) > 0) return true;
  const auto next = entries_.lower_bound(table + ".");
  return next != entries_.end() && next->first.compare(0, table.size() + 1, table + ".") == 0;
}

Place MechanismReader::table_place(std::string_view table) const {
  const auto found = tables_.find(std::string(table));
  return found == tables_.end() ? Place{name_, 0, 0} : found->second;
}

// ---- 1. text → tree -------------------------------------------------------------------------------------------------

void MechanismReader::parse(std::string_view text) {
  if (text.size() > k_max_file_size) throw InputError(name_, "is larger than 1 MB: this is no mechanism file");
  if (text.find('\0') != std::string_view::npos)
    throw InputError(name_, "is a binary file",
                     "a mechanism file is TOML, a text, and stands before other files; see fusee new");
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw InputError(name_, "is empty", "fusee new prints a file to start from");
  if (const auto place = too_deep_place(text, name_)) {
    throw InputError(Diagnostic{Severity::error, *place, "tables or lists nest too deep",
                                "a mechanism file has tables of plain keys only"});
  }
  try {
    root_ = toml::parse(text, name_);
  } catch (const toml::parse_error& error) {
    throw InputError(Diagnostic{Severity::error, place_of(error.source(), name_), syntax_error(error.description()),
                                syntax_hint(text, static_cast<std::size_t>(error.source().begin.line))});
  }
}

// ---- 2. tree → entries ----------------------------------------------------------------------------------------------

void MechanismReader::fail_unknown(const Place& place, const std::string& table, const std::string& key) {
  const std::string shown = (table.empty() ? "" : table + ".") + as_shown(key);
  std::vector<std::string> here, everywhere;
  for (const Field& field : fields()) {
    if (field.key == key) {
      const std::string belongs = field.table.empty() ? "the top of the file" : "[" + std::string(field.table) + "]";
      return fail(place, "unknown key " + shown, field.name() + ": " + key + " belongs in " + belongs);
    }
    if (field.table == table) here.emplace_back(field.key);
    everywhere.emplace_back(field.key);
  }
  // length_in, length_cm
  const std::size_t unit = std::min(key.rfind('_'), key.size());
  const std::string in_mm = key.substr(0, unit) + "_mm", word = key.substr(std::min(unit + 1, key.size()));
  if ((word == "in" || word == "inch" || word == "cm") && find_field(table + "." + in_mm) != nullptr)
    return fail(place, "unknown key " + shown,
                in_mm + " takes a text with its unit, such as \"3.5 " + word +
                    "\"; units = \"inch\" at the top of the file makes all lengths inches");
  std::string nearest = nearest_word(key, here);
  // A setting is written with its table, a key of the file without.
  const std::string dotted = place.line == 0 && !table.empty() ? table + "." : "";
  if (!nearest.empty()) return fail(place, "unknown key " + shown, "did you mean " + dotted + nearest + "?");
  nearest = nearest_word(key, everywhere);
  for (const Field& field : fields()) {
    if (field.key == nearest) return fail(place, "unknown key " + shown, "did you mean " + field.name() + "?");
  }
  fail(place, "unknown key " + shown,
       table.empty() ? "" : "fusee explain " + table + " lists the keys of [" + table + "]");
}

void MechanismReader::take_former_key(const FormerKey& former, const toml::table& table, const Entry& entry) {
  for (const std::string_view now : former.now) {
    if (table.contains(now.substr(now.find('.') + 1)))
      return fail(entry.place,
                  std::string(former.name) + " was replaced by " + std::string(former.now[0]) + " and " +
                      std::string(former.now[1]) + " now, one of which is present as well",
                  "delete " + std::string(former.name));
    entries_[std::string(now)] = entry;
  }
}

void MechanismReader::flatten_table(const std::string& table, const toml::table& node) {
  for (const auto& [key, value] : node) {
    const std::string name = table + "." + std::string(key.str());
    if (const FormerKey* former = find_former_key(name)) {
      take_former_key(*former, node, {&value, place_of(value.source(), name_)});
    } else if (find_field(name) == nullptr) {
      fail_unknown(place_of(key.source(), name_), table, std::string(key.str()));
    } else {
      entries_[name] = {&value, place_of(value.source(), name_)};
    }
  }
}

void MechanismReader::flatten() {
  const std::vector<std::string> tables = field_tables();
  for (const auto& [key, value] : root_) {
    const std::string name(key.str());
    const Place place = place_of(key.source(), name_);
    if (std::find(tables.begin(), tables.end(), name) != tables.end() && !name.empty()) {
      tables_[name] = place;
      if (value.is_table()) {
        flatten_table(name, *value.as_table());
      } else {
        fail(place, name + " is a table, not " + described(value),
             "write [" + name + "] on a line of its own and its keys below");
      }
    } else if (value.is_table() || value.is_array_of_tables()) {
      const std::string nearest = nearest_word(name, tables);
      fail(place, "unknown table [" + as_shown(name) + "]",
           nearest.empty() ? "fusee explain lists the tables" : "did you mean [" + nearest + "]?");
    } else if (find_field(name) == nullptr || name.find('.') != std::string::npos) {
      fail_unknown(place, "", name);
    } else {
      entries_[name] = {&value, place_of(value.source(), name_)};
    }
  }
}

/// The value of --set as TOML. A bare word or a length with its unit (3 1/2") is taken as a string; anything else is an
/// error.
toml::table MechanismReader::setting_value(const Setting& setting, const std::string& file) {
  const bool one_line = setting.value.find_first_of("\r\n") == std::string::npos;
  if (one_line && setting.value.size() <= 4 * k_max_text_length && !too_deep_place(setting.value, file)) {
    try {
      toml::table table = toml::parse("value = " + setting.value + "\n");
      if (table.size() == 1) return table;
    } catch (const toml::parse_error&) {
      // May be a bare word, see below.
    }
  }
  toml::table table;
  const bool is_word =
      one_line && !setting.value.empty() && setting.value.find_first_of("\"'[]{}=") == std::string::npos;
  if (!is_word && !parse_length(setting.value)) {
    fail({file, 0, 0}, in_quotes(setting.value) + " is not a value",
         "a number, [lowest, highest], true, false or a word");
  } else {
    try {
      table = toml::parse("value = " + toml_string(setting.value) + "\n");
    } catch (const toml::parse_error&) {
      fail({file, 0, 0}, in_quotes(setting.value) + " is not a text", "text is UTF-8");
    }
  }
  return table;
}

void MechanismReader::apply(const Setting& setting) {
  const std::string file = "--set " + as_shown(setting.key + "=" + setting.value);
  const std::size_t dot = setting.key.find('.');
  if (const auto one = find_number_key(setting.key); one && one->field->kind != FieldKind::number) {
    setting_values_.push_back(std::make_unique<toml::table>(setting_value(setting, file)));
    if (const toml::node* node = setting_values_.back()->get("value"))
      pair_settings_.push_back({*one, {node, {file, 0, 0}}});
    return;
  }
  if (find_field(setting.key) == nullptr) {
    const std::string table = dot == std::string::npos ? "" : setting.key.substr(0, dot);
    const std::vector<std::string> tables = field_tables();
    if (std::find(tables.begin(), tables.end(), table) == tables.end()) {
      const std::string nearest = nearest_word(table, tables);
      return fail({file, 0, 0}, "unknown table " + in_quotes(table),
                  nearest.empty() ? "fusee explain lists the tables" : "did you mean " + nearest + "?");
    }
    return fail_unknown({file, 0, 0}, table, dot == std::string::npos ? setting.key : setting.key.substr(dot + 1));
  }
  setting_values_.push_back(std::make_unique<toml::table>(setting_value(setting, file)));
  if (const toml::node* node = setting_values_.back()->get("value")) {
    entries_[setting.key] = {node, {file, 0, 0}};
  } else {
    entries_.erase(setting.key);
    good_[setting.key] = false;  // its error is reported; do not report it as missing as well
  }
}

// ---- 3. entries → fields --------------------------------------------------------------------------------------------

/// The value as the user wrote it, with its unit.
std::string as_written(const Field& field, const toml::node& node, LengthUnit units) {
  return node.is_string() ? in_quotes(**node.as_string())
                          : with_unit(*node.value<double>(), unit_in_file(field, units));
}

/// True for a length where 0 means a default or "none". Drawings round to 1e-6 mm, so that a tiny length would be
/// neither 0 nor usable.
bool is_declared_length(const Field& field) {
  return field.unit == "mm" && field.least == 0 && field.table != "identified";
}

void MechanismReader::take_number(const Field& field, const Entry& entry, int end, const toml::node& node) {
  const std::optional<double> value = written_number(field.key, node, mechanism_.units);
  const Place place = entry.place.line > 0 ? place_of(node.source(), entry.place.file) : entry.place;
  const std::string allowed = "allowed: " + allowed_text(field, mechanism_.units);
  if (!value) return fail_number(field, place, node);
  const bool whole_if_required = !field.whole || std::trunc(*value) == *value;
  if (!std::isfinite(*value) || !whole_if_required)
    return fail(
        place,
        field.name() + " must be a " + (whole_if_required ? "finite" : "whole") + " number, not " + shortest(*value),
        allowed);
  const std::string shown = field.name() + " = " + as_written(field, node, mechanism_.units);
  if (*value < field.least || *value > field.most) return fail(place, shown + " is out of range", allowed);
  if (is_declared_length(field) && *value > 0 && *value < k_min_length) {
    return fail(place, shown + " is less than a micrometre",
                "0, or at least " + rounded(from_mm(k_min_length, mechanism_.units)) + " " +
                    std::string(unit_in_file(field, mechanism_.units)));
  }
  field.set(mechanism_, end, *value);
  good_[field.name()] = true;
}

/// Reports a value that is no number. A text of a length may lack its unit, or have an unknown one.
void MechanismReader::fail_number(const Field& field, const Place& place, const toml::node& node) {
  const std::string kind = kind_text(field, mechanism_.units);
  std::string hint = "allowed: " + allowed_text(field, mechanism_.units);
  if (is_length(field.key) && node.is_string()) hint += "; a text has its unit: \"3 1/2 in\", \"4.5 cm\" or \"45 mm\"";
  fail(place, field.name() + " must be " + kind + ", not " + described(node), std::move(hint));
}

/// Reads both numbers of a range or point; false if one is invalid.
bool MechanismReader::take_pair(const Field& field, const Entry& entry) {
  const toml::array* ends = entry.node->as_array();
  if (ends == nullptr || ends->size() != 2) {
    fail(entry.place,
         field.name() + " must be " + kind_text(field, mechanism_.units) + ", not " + described(*entry.node),
         "allowed: " + allowed_text(field, mechanism_.units));
    return false;
  }
  const std::size_t errors = errors_.size();
  take_number(field, entry, 0, (*ends)[0]);
  take_number(field, entry, 1, (*ends)[1]);
  good_[field.name()] = errors == errors_.size();
  return good_[field.name()];
}

void MechanismReader::take_range(const Field& field, const Entry& entry) {
  if (!take_pair(field, entry)) return;
  const toml::array* ends = entry.node->as_array();
  const double lowest = *(*ends)[0].value<double>(), highest = *(*ends)[1].value<double>();
  demand_home(field, entry, lowest, highest);
}

void MechanismReader::demand_home(const Field& field, const Entry& entry, double lowest, double highest) {
  if (lowest <= 0 && highest >= 0 && lowest < highest) return;
  good_[field.name()] = false;
  fail(entry.place, field.name() + " = [" + shortest(lowest) + ", " + shortest(highest) + "] deg does not include home",
       lowest > highest && lowest >= 0 && highest <= 0
           ? "the lowest angle stands first: [" + shortest(highest) + ", " + shortest(lowest) + "]"
           : "the lowest angle is at most 0, the highest at least 0, and they differ");
}

/// Texts appear in drawings, pages, program comments and on the terminal, so they must be one printable line.
bool MechanismReader::demand_line(const Field& field, const Place& place, const std::string& text) {
  if (text.size() > k_max_text_length) {
    fail(place, field.name() + " must be one line of at most " + std::to_string(k_max_text_length) + " bytes",
         "take a shorter text");
  } else if (cleaned_line(text) != text) {
    fail(place, field.name() + " = " + in_quotes(text) + " contains a character that a one-line text must not have",
         "leave out control characters, line ends and marks that change the direction of writing");
  } else {
    return true;
  }
  return false;
}

void MechanismReader::take_text(const Field& field, const Entry& entry) {
  std::string value;
  if (field.kind == FieldKind::boolean) {
    if (!entry.node->is_boolean())
      return fail(entry.place, field.name() + " must be true or false, not " + described(*entry.node));
    value = **entry.node->as_boolean() ? "true" : "false";
  } else {
    if (!entry.node->is_string()) {
      return fail(entry.place, field.name() + " must be " + kind_text(field) + ", not " + described(*entry.node));
    }
    value = **entry.node->as_string();
  }
  if (field.kind == FieldKind::choice &&
      std::find(field.choices.begin(), field.choices.end(), value) == field.choices.end()) {
    const std::string nearest = nearest_word(value, {field.choices.begin(), field.choices.end()});
    return fail(entry.place, field.name() + " = " + in_quotes(value) + " is not known",
                "allowed: " + allowed_text(field) + (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
  }
  if (!demand_line(field, entry.place, value)) return;
  field.set_text(mechanism_, value);
  good_[field.name()] = true;
}

void MechanismReader::take_numbers(const Field& field, const Entry& entry) {
  const toml::array* list = entry.node->as_array();
  if (list == nullptr || list->size() > k_max_list_length) {
    return fail(entry.place, field.name() + " must be " + kind_text(field) + ", not " + described(*entry.node),
                "for example " + std::string(field.key) + " = [10, 20]");
  }
  std::vector<double>& values = field.numbers(mechanism_);
  values.clear();
  for (const toml::node& node : *list) {
    const std::string_view key = length_key(field, mechanism_, values.size());
    const std::optional<double> value = written_number(key, node, mechanism_.units);
    const Place place = entry.place.line > 0 ? place_of(node.source(), entry.place.file) : entry.place;
    if (!value || !(*value >= field.least && *value <= field.most)) {
      return fail(place, field.name() + " holds numbers, not " + described(node), "allowed: " + allowed_text(field));
    }
    values.push_back(*value);
  }
  good_[field.name()] = true;
}

/// A single text is accepted as a list of one.
void MechanismReader::take_texts(const Field& field, const Entry& entry) {
  const toml::array* list = entry.node->as_array();
  if (!entry.node->is_string() && (list == nullptr || list->size() > k_max_list_length)) {
    return fail(entry.place, field.name() + " must be " + kind_text(field) + ", not " + described(*entry.node));
  }
  std::vector<std::string>& values = field.texts(mechanism_);
  values.clear();
  const auto take_one = [&](const toml::node& node) {
    const Place place = entry.place.line > 0 ? place_of(node.source(), entry.place.file) : entry.place;
    if (!node.is_string())
      return fail(place, field.name() + " holds texts, not " + described(node), "write them in quotes");
    const std::string& value = **node.as_string();
    if (!demand_line(field, place, value)) return;
    if (!field.choices.empty() && std::find(field.choices.begin(), field.choices.end(), value) == field.choices.end()) {
      const std::string nearest = nearest_word(value, {field.choices.begin(), field.choices.end()});
      return fail(place, field.name() + " = " + in_quotes(value) + " is not known",
                  "allowed: " + allowed_text(field) + (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
    }
    values.push_back(value);
  };
  const std::size_t errors = errors_.size();
  if (list == nullptr)
    take_one(*entry.node);
  else
    for (const toml::node& node : *list) take_one(node);
  good_[field.name()] = errors == errors_.size();
}

void MechanismReader::take_pair_settings() {
  for (const auto& [key, entry] : pair_settings_) {
    // One number completes an omitted point, which has a default; an omitted range stays missing.
    if (key.field->kind == FieldKind::range && !entries_.contains(key.field->name())) continue;
    take_number(*key.field, entry, key.end, *entry.node);
    entries_.try_emplace(key.field->name(), entry);
  }
  for (const auto& [key, entry] : pair_settings_) {
    if (key.field->kind == FieldKind::range && entries_.contains(key.field->name()) && good_[key.field->name()])
      demand_home(*key.field, entry, key.field->get(mechanism_, 0), key.field->get(mechanism_, 1));
  }
}

void MechanismReader::take(const Field& field, const Entry& entry) {
  good_[field.name()] = false;
  switch (field.kind) {
    case FieldKind::number:
      return take_number(field, entry, 0, *entry.node);
    case FieldKind::range:
      return take_range(field, entry);
    case FieldKind::point:
      take_pair(field, entry);
      return;
    case FieldKind::choice:
    case FieldKind::text:
    case FieldKind::boolean:
      return take_text(field, entry);
    case FieldKind::numbers:
      return take_numbers(field, entry);
    case FieldKind::texts:
      return take_texts(field, entry);
  }
}

/// True if this mechanism uses the key. If the choice that decides about that is invalid, the key counts as unused, so
/// that it is not reported as missing.
bool MechanismReader::is_needed(const Field& field) const {
  const std::string decider(field.only_when.substr(0, field.only_when.find('=')));
  const auto decided = good_.find(decider);
  return (decided == good_.end() || decided->second) && is_used(field, mechanism_);
}

void MechanismReader::report_missing() {
  const bool is_by_ratio = has_table("transmission");
  for (const Field& field : fields()) {
    // Only [transmission] has mandatory keys for a joint declared by a ratio, only other tables for a joint with
    // tendons.
    const bool is_of_ratio = field.table == "transmission";
    if (!field.table.empty() && is_of_ratio != is_by_ratio) continue;
    const bool conditional = !field.only_when.empty() && field.fallback.empty() && is_needed(field) && !is_by_ratio;
    if (!(field.required || conditional) || good_.count(field.name()) > 0) continue;
    const std::string where =
        field.table.empty() ? "at the top of the file" : "under [" + std::string(field.table) + "]";
    const std::string example =
        field.least == field.most && field.kind == FieldKind::number ? shortest(field.least) : "...";
    fail(table_place(field.table),
         "missing key " + field.name() + (conditional ? " (required with " + condition_text(field) + ")" : ""),
         "add " + std::string(field.key) + " = " + example + " " + where + ": " + std::string(field.meaning) + "; " +
             allowed_text(field, mechanism_.units));
  }
}

// ---- 4. keys against each other -------------------------------------------------------------------------------------

void MechanismReader::check_transmission() {
  if (!has_table("transmission")) return;
  for (const char* table : {"joint", "guides", "sheath", "pulley"}) {
    if (!has_table(table)) continue;
    fail(table_place(table), std::string("[") + table + "] and [transmission] cannot both be declared",
         "[transmission] stands in place of [joint], [guides] and [pulley]: leave one side out");
  }
  if (good_.count("transmission.ratio") > 0 && good_["transmission.ratio"] && mechanism_.transmission->ratio == 0) {
    fail(entries_["transmission.ratio"].place, "transmission.ratio must not be 0",
         "theta = offset + alpha/ratio: use any other number");
  }
}

void MechanismReader::check_unused() {
  for (const Field& field : fields()) {
    const auto entry = entries_.find(field.name());
    if (entry == entries_.end() || is_used(field, mechanism_)) continue;
    // If the deciding key is itself unused, the message names its condition.
    const Field* decider = find_field(field.only_when.substr(0, field.only_when.find('=')));
    const Field& unmet = is_used(*decider, mechanism_) ? field : *decider;
    warn(entry->second.place, field.name() + " is not used: it is for " + condition_text(unmet) + " only");
  }
}

void MechanismReader::check_drum() {
  const char* key = "joint.drum_friction";
  if (!(mechanism_.joint.drum_mu > 0 && mechanism_.joint.drum_radius == 0) || !has(key)) return;
  if (!has("joint.drum_radius_mm") || good_["joint.drum_radius_mm"])
    warn(entries_[key].place, "joint.drum_friction is not used: there is no joint.drum_radius_mm");
}

void MechanismReader::check_idlers() {
  const Guides& guides = mechanism_.guides;
  if (guides.kind != GuideKind::idler) return;
  if (has("guides.friction")) {
    warn(entries_["guides.friction"].place, "guides.friction is not used: idlers use guides.bearing_friction");
  }
  if (guides.bearing_radius > guides.radius && good_["guides.kind"]) {
    const std::string key =
        has("guides.bearing_radius_mm") || !has("guides.radius_mm") ? "guides.bearing_radius_mm" : "guides.radius_mm";
    fail(has(key) ? entries_[key].place : entries_["guides.kind"].place,
         "an idler's bearing of radius " + shortest(guides.bearing_radius) +
             " mm (guides.bearing_radius_mm) does not fit into "
             "an idler of " +
             shortest(guides.radius) + " mm (guides.radius_mm)",
         "guides.radius_mm is the idler's radius at the floor of its groove");
  }
}

/// Checks the keys that a sheath requires.
void MechanismReader::check_sheath() {
  if (!has_table("sheath")) return;
  for (const Field& field : fields()) {
    if (field.table != "sheath" || !field.needed_in_table || has(field.name())) continue;
    fail(table_place("sheath"), "missing key " + field.name() + " (required with [sheath])",
         "add " + std::string(field.key) + " = ... under [sheath]: " + std::string(field.meaning) + "; " +
             allowed_text(field, mechanism_.units));
  }
  if (mechanism_.pulley.method == Method::paper && good_["pulley.method"])
    fail(table_place("sheath"), "[sheath] cannot be combined with pulley.method = \"paper\"",
         "the paper's tendons run from pin to pulley: use method = \"exact\"");
}

/// The paper's formulas have neither drum nor separate attachments.
void MechanismReader::check_method() {
  if (mechanism_.pulley.method != Method::paper) return;
  for (const char* key : {"joint.drum_radius_mm", "joint.attachment1_mm", "joint.attachment2_mm"}) {
    if (!has(key) || !good_[key] || !find_field(key)->is_set(mechanism_)) continue;
    fail(entries_[key].place, std::string(key) + " cannot be combined with pulley.method = \"paper\"",
         "the paper's joint has one attachment C and no drum: use method = \"exact\"");
  }
}

void MechanismReader::check_horn() {
  const Body& body = mechanism_.body;
  if (body.bore != Bore::horn || !good_["body.bore"]) return;
  const auto own_horn_key = std::find_if(fields().begin(), fields().end(), [this](const Field& field) {
    return field.table == "horn" && has(field.name()) && (!good_[field.name()] || field.get(mechanism_, 0) != 0);
  });
  if (body.horn != k_own_horn) {
    if (find_horn(body.horn) == nullptr) {
      std::vector<std::string> names;
      for (const HornType& type : horns()) names.push_back(type.name);
      const std::string nearest = nearest_word(body.horn, names);
      fail(entries_["body.horn"].place, "body.horn = " + in_quotes(body.horn) + " is not known",
           (nearest.empty() ? "" : "did you mean \"" + nearest + "\"? ") +
               std::string("fusee explain body.horn lists the horns; [horn] describes one of your own"));
    }
    if (own_horn_key != fields().end()) {
      fail(entries_[own_horn_key->name()].place,
           own_horn_key->name() + " describes a horn, and body.horn = " + in_quotes(body.horn) + " names another",
           "leave out either body.horn or [horn]");
    }
    return;
  }
  if (own_horn_key == fields().end()) {
    return fail(entries_["body.bore"].place, "body.bore = \"horn\" requires a horn",
                "name one with body.horn (fusee explain body.horn lists them), or describe yours under [horn]");
  }
  const bool all_read = std::all_of(fields().begin(), fields().end(), [this](const Field& field) {
    return field.table != "horn" || !has(field.name()) || good_[field.name()];
  });
  if (!all_read) return;
  for (const HornFault& fault : faults_of(mechanism_.horn)) {
    const auto entry = entries_.find("horn." + std::string(fault.key));
    fail(entry == entries_.end() ? table_place("horn") : entry->second.place, fault.message, fault.hint);
  }
}

/// The speed has two keys, of which one may be given. A quantity that is to be compared requires a known limit.
void MechanismReader::check_motor() {
  const bool all_read = std::all_of(fields().begin(), fields().end(), [this](const Field& field) {
    return field.table != "motor" || !has(field.name()) || good_[field.name()];
  });
  if (!has_table("motor") || !all_read) return;
  if (has("motor.speed_rpm") && has("motor.speed_deg_per_s"))
    fail(entries_["motor.speed_rpm"].place, "motor.speed_rpm and motor.speed_deg_per_s both define the motor's speed",
         "leave one of them out");
  const MotorModel limits = motor_limits(mechanism_.motor);
  if (mechanism_.motor.enforce && limits.travel == 0 && limits.stall_torque == 0 && limits.speed == 0)
    fail(entries_["motor.enforce"].place, "motor.enforce = true has no limit to enforce",
         "add motor.model (fusee explain motor.model lists the motors), motor.travel_deg, motor.stall_torque_Nmm or "
         "motor.speed_deg_per_s");
  if (has("motor.joint_speed_deg_per_s") && limits.speed == 0)
    warn(entries_["motor.joint_speed_deg_per_s"].place,
         "motor.joint_speed_deg_per_s is not compared: the motor's speed is unknown",
         "choose motor.model (fusee explain motor.model lists the motors), or add motor.speed_deg_per_s; motors of the "
         "catalogue that suffice are listed in either case");
}

/// A shaft supplies omitted keys; written keys must agree with it.
void MechanismReader::take_shaft() {
  const ShaftType* shaft = find_shaft(mechanism_.body.shaft);
  if (shaft == nullptr) return;
  DeclaredMechanism with_shaft = mechanism_;
  with_shaft.body.bore = shaft->bore;
  with_shaft.body.bore_diameter = shaft->diameter;
  with_shaft.body.bore_flat = shaft->flat;
  for (const char* key : {"body.bore", "body.bore_diameter_mm", "body.bore_flat_mm"}) {
    const Field& field = *find_field(key);
    if (!has(key) || !good_[key]) continue;
    const auto value_in = [&field](const DeclaredMechanism& mechanism) {
      return field.get ? with_unit(field.get(mechanism, 0), field.unit) : in_quotes(field.get_text(mechanism));
    };
    if (value_in(mechanism_) == value_in(with_shaft)) continue;
    fail(entries_[key].place,
         std::string(key) + " = " + value_in(mechanism_) + " is not that of body.shaft = " + in_quotes(shaft->name) +
             ", which is " + value_in(with_shaft),
         "leave out " + std::string(key) + ", which the shaft defines, or body.shaft");
  }
  mechanism_.body = with_shaft.body;
}

/// Checks [optimize]. An error about an item of a list has the item's place; a single text or a --set value has one
/// place.
void MechanismReader::check_optimize() {
  if (!has_table("optimize")) return;
  const auto item_place = [this](const std::string& key, std::size_t item) {
    const auto entry = entries_.find("optimize." + key);
    if (entry == entries_.end()) return table_place("optimize");
    const toml::array* list = entry->second.node->as_array();
    if (entry->second.place.line == 0 || list == nullptr || item >= list->size()) return entry->second.place;
    return place_of((*list)[item].source(), name_);
  };
  const auto is_good = [this](const std::string& key) {
    const auto found = good_.find("optimize." + key);
    return found == good_.end() || found->second;
  };
  check_optimize_table(mechanism_.optimize, is_good, item_place, errors_);
}

void MechanismReader::check_prior() {
  for (const Field& field : fields()) {
    const auto entry = entries_.find(field.name());
    if (field.table != "prior" || entry == entries_.end() || !good_[field.name()]) continue;
    const std::vector<double>& reading = field.numbers(mechanism_);
    if (reading.empty() || (reading.size() == 2 && reading[1] > 0)) continue;
    fail(entry->second.place, field.name() + " must be two numbers: the value and its standard uncertainty, above 0",
         "for example " + field.name() + " = [2.4, 0.02]");
  }
}

void MechanismReader::load_law_table() {
  PulleyDrive& pulley = mechanism_.pulley;
  if (pulley.law != Law::table && pulley.law != Law::torque) return;
  const bool torque = pulley.law == Law::torque;
  const std::string key = torque ? "pulley.torque_table" : "pulley.table";
  const std::string& table = torque ? pulley.torque_table : pulley.table;
  if (!has(key) || !good_[key] || !good_["joint.range_deg"] || (torque && table.empty())) return;
  const std::filesystem::path path = folder_ / std::filesystem::path(table);
  try {
    const std::string csv = read_file(path, k_max_table_size, files_);
    if (torque)
      pulley.torque_rows = parse_torque_table(csv, path.string(), mechanism_.joint, table_errors_);
    else
      pulley.rows = parse_law_table(csv, path.string(), mechanism_.joint, table_errors_);
  } catch (const InputError& error) {
    const Diagnostic& cause = error.diagnostics().front();
    std::string of_template;
    for (const TemplateTable& known : template_tables())
      if (known.file == path.filename())
        of_template = "'fusee new " + known.template_name + " -o " + known.template_name +
                      ".toml' writes the template's table beside its file; ";
    fail(entries_[key].place, key + ": " + cause.place.file + ": " + cause.message,
         of_template + "a CSV file with columns " + (torque ? "theta_deg,motor_torque_Nmm" : "alpha_deg,theta_deg") +
             "; its path is relative to the mechanism file");
  }
}

/// A torque law requires exactly one source of the wanted torque.
void MechanismReader::check_torque_law() {
  const PulleyDrive& pulley = mechanism_.pulley;
  if (pulley.law != Law::torque || !good_["pulley.law"]) return;
  const auto is_read = [this](const char* key) { return !has(key) || good_[key]; };
  if (!is_read("pulley.motor_torque_Nmm") || !is_read("pulley.torque_table")) return;
  if (pulley.motor_torque == 0 && pulley.torque_table.empty()) {
    fail(entries_["pulley.law"].place, "pulley.law = \"torque\" requires a wanted torque",
         "add pulley.motor_torque_Nmm, a constant torque, or pulley.torque_table, a CSV file with columns "
         "theta_deg,motor_torque_Nmm");
  }
  if (pulley.motor_torque != 0 && !pulley.torque_table.empty()) {
    fail(entries_["pulley.torque_table"].place,
         "pulley.torque_table and pulley.motor_torque_Nmm both define the wanted torque", "leave one of them out");
  }
  if (pulley.method == Method::paper) {
    fail(entries_["pulley.method"].place, "pulley.law = \"torque\" cannot be combined with pulley.method = \"paper\"",
         "the paper has no such law: use method = \"exact\"");
  }
}

// ---- the whole ------------------------------------------------------------------------------------------------------

void MechanismReader::finish(std::vector<Diagnostic>* warnings) {
  // Order: by place in the file, then errors about the whole file, then --set.
  const auto key = [this](const Diagnostic& d) {
    return std::make_tuple(d.place.file != name_, d.place.line == 0, d.place.line, d.place.column);
  };
  const auto by_place = [&key](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); };
  for (std::vector<Diagnostic>* all : {&errors_, &warnings_}) {
    for (Diagnostic& diagnostic : *all) {
      diagnostic.message = lengths_in(mechanism_.units, diagnostic.message);
      diagnostic.hint = lengths_in(mechanism_.units, diagnostic.hint);
    }
  }
  std::stable_sort(errors_.begin(), errors_.end(), by_place);
  std::stable_sort(warnings_.begin(), warnings_.end(), by_place);
  errors_.insert(errors_.end(), table_errors_.begin(), table_errors_.end());
  if (errors_.size() > k_max_errors) {
    const std::size_t more = errors_.size() - k_max_errors;
    errors_.resize(k_max_errors);
    fail({name_, 0, 0}, "and " + std::to_string(more) + " more errors");
  }
  if (!errors_.empty()) throw InputError(errors_);
  if (warnings != nullptr) *warnings = warnings_;
}

DeclaredMechanism MechanismReader::read(std::string_view text, const std::vector<Setting>& settings,
                                        std::vector<Diagnostic>* warnings) {
  parse(text);
  mechanism_ = default_mechanism();
  flatten();
  for (const Setting& setting : settings) apply(setting);
  for (const Field& field : fields()) {
    const auto entry = entries_.find(field.name());
    if (entry != entries_.end()) take(field, entry->second);
  }
  take_pair_settings();
  take_shaft();
  report_missing();
  check_transmission();
  check_unused();
  check_method();
  check_torque_law();
  check_drum();
  check_idlers();
  check_sheath();
  check_horn();
  check_motor();
  check_optimize();
  check_prior();
  load_law_table();
  finish(warnings);
  return mechanism_;
}

KeyPlaces MechanismReader::places() const {
  KeyPlaces all;
  for (const auto& [key, entry] : entries_) all[key] = entry.place;
  return all;
}

}  // namespace

DeclaredMechanism parse_mechanism(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                                  const std::vector<Setting>& settings, std::vector<Diagnostic>* warnings,
                                  KeyPlaces* places, FileAccess& files) {
  MechanismReader reader(name, folder, files);
  DeclaredMechanism mechanism = reader.read(text, settings, warnings);
  if (places != nullptr) *places = reader.places();
  return mechanism;
}

Place MechanismFile::place_of(std::string_view key) const {
  const auto found = places.find(key);
  return found == places.end() ? Place{path, 0, 0} : found->second;
}

MechanismFile read_mechanism(const std::filesystem::path& path, const std::vector<Setting>& settings,
                             FileAccess& files) {
  const std::string text = read_file(path, k_max_file_size, files);
  MechanismFile file;
  file.path = path.string();
  file.sha256 = sha256(text);
  file.settings = settings;
  file.mechanism = parse_mechanism(text, file.path, path.parent_path(), settings, &file.warnings, &file.places, files);
  return file;
}

}  // namespace fusee
