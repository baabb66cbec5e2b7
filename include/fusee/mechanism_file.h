/// \file
/// The mechanism file (TOML): reading, writing, its keys, and edits that keep a user's layout.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"

namespace fusee {

// ---- Keys -----------------------------------------------------------------------------------------------------------
// The field table: one row for each key of the mechanism file. It serves the reader, the writer, `fusee explain`,
// `fusee new`, the JSON schema and the search for advice.

/// range: two numbers, lower ≤ 0 ≤ upper. point: two numbers, across and along.
enum class FieldKind { number, range, choice, text, boolean, numbers, texts, point };

/// One key: its table, unit, bounds, default, meaning and member.
struct Field {
  std::string_view table;   ///< "joint"; "" for the keys at the top of the file
  std::string_view key;     ///< "length_mm": includes the unit
  std::string_view symbol;  ///< the paper's symbol or "" ("R")
  FieldKind kind = FieldKind::number;
  std::string_view unit;  ///< "mm", "deg", "N", "MPa", "%" or "" (a plain number)
  /// True for mandatory keys. With [transmission], only its own keys are mandatory.
  bool required = false;
  bool needed_in_table = false;  ///< mandatory when its table is present
  /// "pulley.law=compensate": the key is used only with that value, and only where pulley.law itself is used; otherwise
  /// a warning. If used, it is mandatory unless it has a default.
  std::string_view only_when;
  /// Default as it would be written in the file ("0.12", "\"u\"", "true"); "" when there is none.
  std::string_view fallback;
  /// Effective value, in words, of an omitted key without a default of its own ("[0, length_mm]").
  std::string_view otherwise;
  /// Optional keys that are usually omitted: true when this mechanism has a value to write. Null: always written.
  bool (*is_set)(const DeclaredMechanism&) = nullptr;
  /// Inclusive bounds in the key's unit for numbers and both ends of ranges.
  double least = 0;
  double most = 0;
  bool whole = false;                     ///< an integer
  std::vector<std::string_view> choices;  ///< allowed values of a choice
  std::string_view meaning;               ///< explanation in one line

  /// Value in the key's unit (mm for lengths, whatever the file's `units`), for number, range and point only. `end`: 0
  /// or 1 for range and point.
  std::function<double(const DeclaredMechanism&, int end)> get;
  std::function<void(DeclaredMechanism&, int end, double value)> set;
  /// Text of a choice, text or boolean ("true"/"false").
  std::string (*get_text)(const DeclaredMechanism&) = nullptr;
  void (*set_text)(DeclaredMechanism&, std::string_view value) = nullptr;
  /// The member of a list: numbers or texts.
  std::vector<double>& (*numbers)(DeclaredMechanism&) = nullptr;
  std::vector<std::string>& (*texts)(DeclaredMechanism&) = nullptr;

  std::string name() const;  ///< "joint.length_mm"
};

/// All fields in file order.
std::span<const Field> fields();
/// Finds a field by its dotted name; null when there is none.
const Field* find_field(std::string_view name);

/// A key of earlier file versions whose number is now the value of two keys.
struct FormerKey {
  std::string_view name;                ///< dotted name of the former key
  std::array<std::string_view, 2> now;  ///< dotted names of the two keys that replace it
};
/// Finds a former key by its dotted name; null when there is none.
const FormerKey* find_former_key(std::string_view name);

/// The value of a number, or of one end of a range, in the key's unit.
double number_of(const Mechanism& mechanism, const Field& field, int end = 0);
/// Sets a number, or one end of a range, in the key's unit. Bounds are not checked.
void set_number(Mechanism& mechanism, const Field& field, int end, double value);

/// The number with the fewest digits, in the key's unit, that reads back as the stored value. Only for number, range
/// and point.
std::string number_text(const Field& field, const DeclaredMechanism& mechanism, int end);

/// A variable number: a field of kind number, or one end of a pair ("joint.range_deg[0]").
struct NumberKey {
  const Field* field = nullptr;
  int end = 0;

  /// The number in the key's unit.
  double get(const DeclaredMechanism& mechanism) const { return field->get(mechanism, end); }
  void set(DeclaredMechanism& mechanism, double value) const { field->set(mechanism, end, value); }
};
/// Finds a number by its dotted name; null when the key is unknown or holds no number.
std::optional<NumberKey> find_number_key(std::string_view name);
/// All names that find_number_key() knows.
std::vector<std::string> number_key_names();

/// The tables in file order; "" (the top of the file) first.
std::vector<std::string> field_tables();
/// Description of a table, in one line.
std::string_view table_meaning(std::string_view table);

/// True when this mechanism uses the key (see Field::only_when).
bool is_used(const Field& field, const DeclaredMechanism& mechanism);
/// A mechanism with the defaults only.
DeclaredMechanism default_mechanism();

// ---- Edits ----------------------------------------------------------------------------------------------------------
// Edits of values in a user's file that keep its comments, order and layout.

/// A new number for a key, in the key's unit. In an inch file a length is written in inches.
struct ValueEdit {
  std::string key;  ///< known to find_number_key()
  double value = 0;
};

/// Replaces the values of these keys in `text`. A missing key is added below its table's header, or with its table at
/// the end; a pair gets both numbers. `text` must be a valid mechanism file.
std::string edit_values(std::string_view text, const std::vector<ValueEdit>& edits);

// ---- Reading and writing --------------------------------------------------------------------------------------------
// Reading and writing of mechanism files (TOML), and the texts of `fusee explain`, `fusee new` and the editor schema.

/// "table.key=value" from the command line. The value is TOML ("100", "[-20, 20]", "\"linear\""); a bare word is a
/// string.
struct Setting {
  std::string key;
  std::string value;
};

/// Place of each written key, by dotted name. Keys from --set have the setting as their file.
using KeyPlaces = std::map<std::string, Place, std::less<>>;

/// A mechanism read from a file, with the data that a manifest needs.
struct MechanismFile {
  DeclaredMechanism mechanism;
  std::string path;
  std::string sha256;  ///< of the file's bytes, without settings
  std::vector<Diagnostic> warnings;
  KeyPlaces places;
  std::vector<Setting> settings = {};  ///< with which the file was read

  /// The place of a key; the whole file if the key was not written.
  Place place_of(std::string_view key) const;
};

/// Reads a file, fills in defaults, applies `settings`, and loads the table of the law. Checks each key against the
/// field table and the keys against each other. Throws InputError with *all* errors of the file.
MechanismFile read_mechanism(const std::filesystem::path& path, const std::vector<Setting>& settings = {},
                             FileAccess& files = disk());

/// As read_mechanism(), from text. `name` is used in messages; tables are searched in `folder`.
DeclaredMechanism parse_mechanism(std::string_view text, const std::string& name,
                                  const std::filesystem::path& folder = ".", const std::vector<Setting>& settings = {},
                                  std::vector<Diagnostic>* warnings = nullptr, KeyPlaces* places = nullptr,
                                  FileAccess& files = disk());

/// A complete file, where each key has its meaning, unit, range and default as a comment. parse(write(m)) == m.
std::string write_mechanism(const DeclaredMechanism& mechanism);

/// Text of `fusee explain`: for a key ("r1_mm", "pulley.r1_mm"), a table ("pulley") or "" for the list. Throws
/// InputError with the nearest key.
std::string explain(std::string_view key);
/// The explanation as JSON text.
std::string explain_json(std::string_view key);

/// JSON schema of the mechanism file, for editors.
std::string mechanism_schema();

/// Templates of `fusee new`: the files of profiles/, compiled in, in the order of profiles/catalogue/templates.toml.
struct Template {
  std::string_view name;
  std::string_view text;
  std::string group;        ///< "fingers"; templates of a group are neighbours
  std::string description;  ///< one sentence
};
/// All templates.
std::vector<Template> templates();
/// The text of a template. Throws InputError with the nearest name.
std::string_view find_template(std::string_view name);

}  // namespace fusee
