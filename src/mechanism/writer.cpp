#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/text.h"
#include "fusee/mechanism_file.h"
#include "mechanism/field_text.h"
#include "mechanism/lengths.h"

namespace fusee {
namespace {

bool reads_back(const Field& field, const DeclaredMechanism& mechanism, int end, const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  DeclaredMechanism copy = mechanism;
  field.set(copy, end, value);
  return copy == mechanism;
}

}  // namespace

/// Conversion from degrees or percent rounds, so the nearest number in the file's unit may miss by one bit where a
/// neighbour is exact. Values that no number of the file's unit reproduces are written with an error in the last bit.
std::string number_text(const Field& field, const DeclaredMechanism& mechanism, int end) {
  const double value = field.get(mechanism, end);
  for (int digits = 1; digits <= 17; ++digits) {
    std::string text = fmt::format("{:.{}g}", value, digits);
    double rounded_value = 0;
    std::from_chars(text.data(), text.data() + text.size(), rounded_value);
    text = shortest(rounded_value);
    if (reads_back(field, mechanism, end, text)) return text;
  }
  constexpr int k_neighbours = 4;
  double below = value, above = value;
  for (int i = 0; i < k_neighbours; ++i) {
    below = std::nextafter(below, -INFINITY);
    above = std::nextafter(above, INFINITY);
    for (const double neighbour : {below, above}) {
      if (reads_back(field, mechanism, end, shortest(neighbour))) return shortest(neighbour);
    }
  }
  return shortest(value);
}

namespace {

template <typename List, typename ToText>
std::string list_text(const List& list, ToText to_text) {
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ", ") + to_text(item);
  return "[" + text + "]";
}

/// A number, or one of a pair, in the file's unit.
std::string end_text(const Field& field, const DeclaredMechanism& mechanism, int end) {
  return is_length(field.key) ? length_value_text(field.get(mechanism, end), mechanism.units)
                              : number_text(field, mechanism, end);
}

std::string numbers_text(const Field& field, DeclaredMechanism& mechanism) {
  std::vector<std::string> items;
  for (const double value : field.numbers(mechanism)) {
    const bool length = is_length(length_key(field, mechanism, items.size()));
    items.push_back(length ? length_value_text(value, mechanism.units) : shortest(value));
  }
  return list_text(items, [](const std::string& item) { return item; });
}

std::string value_text(const Field& field, const DeclaredMechanism& mechanism) {
  DeclaredMechanism copy = mechanism;  // lists are accessed through a mutable reference
  switch (field.kind) {
    case FieldKind::number:
      return end_text(field, mechanism, 0);
    case FieldKind::range:
    case FieldKind::point:
      return "[" + end_text(field, mechanism, 0) + ", " + end_text(field, mechanism, 1) + "]";
    case FieldKind::boolean:
      return field.get_text(mechanism);
    case FieldKind::choice:
    case FieldKind::text:
      return toml_string(field.get_text(mechanism));
    case FieldKind::numbers:
      return numbers_text(field, copy);
    case FieldKind::texts:
      return list_text(field.texts(copy), toml_string);
  }
  return {};
}

/// True for an unused key whose number is 0, or whose text is empty or the default. It is written as a comment.
bool is_blank(const Field& field, const DeclaredMechanism& mechanism) {
  if (field.only_when.empty() || is_used(field, mechanism)) return false;
  if (field.get != nullptr) return field.get(mechanism, 0) == 0;
  const std::string text = field.get_text(mechanism);
  return text.empty() || toml_string(text) == field.fallback;
}

std::string comment(const Field& field, LengthUnit units) {
  std::string text = "# ";
  if (!field.symbol.empty()) text += std::string(field.symbol) + ": ";
  text += std::string(field.meaning) + "\n#   ";
  if (field.kind != FieldKind::text) text += allowed_text(field, units) + "; ";
  return text + default_text(field) + "\n";
}

}  // namespace

std::string write_mechanism(const DeclaredMechanism& mechanism) {
  std::string text = "# A mechanism file of fusee. `fusee explain KEY` describes a key.\n";
  std::string_view table;
  for (const Field& field : fields()) {
    const bool is_of_tendons =
        field.table == "joint" || field.table == "guides" || field.table == "sheath" || field.table == "pulley";
    if (mechanism.transmission ? is_of_tendons : field.table == "transmission") continue;
    if (field.is_set != nullptr && !field.is_set(mechanism)) continue;
    // A joint declared by a ratio may omit the tendon.
    if (mechanism.transmission && field.name() == "tendon.diameter_mm" && mechanism.tendon.diameter == 0) continue;
    if (field.table != table)
      text += "\n# " + std::string(table_meaning(field.table)) + "\n[" + std::string(field.table) + "]\n";
    table = field.table;
    text += comment(field, mechanism.units);
    if (is_blank(field, mechanism)) {
      text += "# " + std::string(field.key) + " =\n";
    } else {
      text += std::string(field.key) + " = " + value_text(field, mechanism) + "\n";
    }
  }
  return text;
}

}  // namespace fusee
