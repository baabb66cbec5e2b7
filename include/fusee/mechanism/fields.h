/// \file
/// The field table: one row for every key of the mechanism file, from which come the reader, the writer, `fusee
/// explain`, `fusee new`, the JSON schema and the searches for advice.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// range: two numbers, the first the lower one, with 0 between them. point: two numbers, across and along.
enum class FieldKind { number, range, choice, text, boolean, numbers, texts, point };

struct Field {
  std::string_view table;   ///< "joint"; "" for the keys at the top of the file
  std::string_view key;     ///< "length_mm": the unit stands in the name
  std::string_view symbol;  ///< the paper's symbol or "" ("R")
  FieldKind kind = FieldKind::number;
  std::string_view unit;  ///< "mm", "deg", "N", "MPa", "%" or "" (a plain number)
  /// Must be written. Where [transmission] stands in place of the mechanism, only its own keys must.
  bool required = false;
  bool needed_in_table = false;  ///< must be written where its table is
  /// "pulley.law=compensate": the key is used only then, and where pulley.law itself is (a warning otherwise), and must
  /// be written then if it has no default.
  std::string_view only_when;
  /// Default as it would be written in the file ("0.12", "\"u\"", "true"); "" when there is none.
  std::string_view fallback;
  /// What holds where a key that has no default of its own is left out, in words ("[0, length_mm]").
  std::string_view otherwise;
  /// Of a key that a file mostly goes without: whether this mechanism has it. Null: it always stands in what is
  /// written.
  bool (*is_set)(const DeclaredMechanism&) = nullptr;
  /// Inclusive bounds in the file's unit for numbers and both ends of ranges.
  double least = 0;
  double most = 0;
  bool whole = false;                     ///< a number without a fraction
  std::vector<std::string_view> choices;  ///< of a choice
  std::string_view meaning;               ///< one line

  /// In the file's unit. number: the value; range and point: `end` 0 or 1. Only for these.
  std::function<double(const DeclaredMechanism&, int end)> get;
  std::function<void(DeclaredMechanism&, int end, double value)> set;
  /// choice, text and boolean ("true"/"false").
  std::string (*get_text)(const DeclaredMechanism&) = nullptr;
  void (*set_text)(DeclaredMechanism&, std::string_view value) = nullptr;
  /// Lists: numbers and texts. Their members themselves.
  std::vector<double>& (*numbers)(DeclaredMechanism&) = nullptr;
  std::vector<std::string>& (*texts)(DeclaredMechanism&) = nullptr;

  std::string name() const;  ///< "joint.length_mm"
};

/// All fields in the order in which they stand in a file.
std::span<const Field> fields();
/// By dotted name, or null.
const Field* find_field(std::string_view name);

/// A key of files that earlier programs wrote: one number that stands for two by now.
struct FormerKey {
  std::string_view name;
  std::array<std::string_view, 2> now;
};
/// By dotted name, or null.
const FormerKey* find_former_key(std::string_view name);

/// The value of a number (or of one end of a range) of a mechanism of which no more is known, in the file's unit.
double number_of(const Mechanism& mechanism, const Field& field, int end = 0);
void set_number(Mechanism& mechanism, const Field& field, int end, double value);

/// The number with the fewest digits, in the file's unit, that reads back as what the mechanism holds: what a person
/// would have written. Only for number, range and point.
std::string number_text(const Field& field, const DeclaredMechanism& mechanism, int end);

/// A number that can be turned: a field of kind number, or one of two ("joint.range_deg[0]").
struct NumberKey {
  const Field* field = nullptr;
  int end = 0;

  double get(const DeclaredMechanism& mechanism) const { return field->get(mechanism, end); }
  void set(DeclaredMechanism& mechanism, double value) const { field->set(mechanism, end, value); }
};
/// By dotted name; null when there is no such key or it holds no number of the mechanism.
std::optional<NumberKey> find_number_key(std::string_view name);
/// All names that find_number_key() knows.
std::vector<std::string> number_key_names();

/// The tables in the order in which they stand in a file; "" (the top of the file) first.
std::vector<std::string> field_tables();
/// One line on what a table of the file is about.
std::string_view table_meaning(std::string_view table);

/// True when the key has a use in this mechanism (see Field::only_when).
bool is_used(const Field& field, const DeclaredMechanism& mechanism);
/// A mechanism with every default and nothing else.
DeclaredMechanism default_mechanism();

}  // namespace fusee
