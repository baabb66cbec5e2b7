#include <toml++/toml.h>

#include <algorithm>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "mechanism/written_number.h"

namespace fusee {
namespace {

struct Replacement {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;
};

/// Byte offset of a toml++ position. Lines and columns (code points) count from 1.
std::size_t offset_of(std::string_view text, const toml::source_position& position) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < position.line; ++line)
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  if (at == 0 && text.substr(0, 3) == "\xEF\xBB\xBF") at = 3;
  for (toml::source_index column = 1; column < position.column && at < text.size(); ++column) {
    do ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80);
  }
  return at;
}

/// A new number of a key, in the key's unit, as TOML that reads back exactly in a file of `units`.
std::string new_number_text(const Field& field, double value, LengthUnit units) {
  return is_length(field.key) ? length_value_text(value, units) : shortest(value);
}

LengthUnit units_of(const toml::table& root) {
  return root["units"].value_or(std::string_view()) == "inch" ? LengthUnit::inch : LengthUnit::mm;
}

/// The node of a number in the file; null if the file does not contain it.
const toml::node* written_node(const toml::table& root, const NumberKey& key) {
  const toml::node* node = root.at_path(key.field->name()).node();
  if (node == nullptr || key.field->kind == FieldKind::number) return node;
  const toml::array* ends = node->as_array();
  return ends == nullptr ? nullptr : ends->get(static_cast<std::size_t>(key.end));
}

/// The numbers of the file with their new values. Completes a pair when only one of its numbers is edited.
DeclaredMechanism edited_numbers(const toml::table& root, const std::vector<ValueEdit>& edits) {
  DeclaredMechanism mechanism = default_mechanism();
  const LengthUnit units = units_of(root);
  for (const FieldKind kind :
       {FieldKind::number, FieldKind::range, FieldKind::point}) {  // a point's default may depend on a number
    for (const std::string& name : number_key_names()) {
      const auto key = find_number_key(name);
      if (key->field->kind != kind) continue;
      const toml::node* node = written_node(root, *key);
      const auto value = node == nullptr ? std::nullopt : written_number(key->field->key, *node, units);
      if (value) key->set(mechanism, *value);
      for (const ValueEdit& edit : edits) {
        if (edit.key == name) key->set(mechanism, edit.value);
      }
    }
  }
  return mechanism;
}

/// A new line for a key that its table does not contain. `new_tables`: tables that the file does not contain and whose
/// header an earlier line has added; receives the key's table.
Replacement new_line(std::string_view text, const toml::table& root, const Field& field, std::string_view value,
                     std::vector<std::string>& new_tables) {
  const std::string line = std::string(field.key) + " = " + std::string(value);
  const std::string table_name(field.table);
  if (const toml::table* table = root[table_name].as_table()) {
    if (table->is_inline()) {
      const std::size_t at = offset_of(text, table->source().begin) + 1;
      return {at, at, " " + line + (table->empty() ? "" : ",")};
    }
    const std::size_t begin = offset_of(text, table->source().begin);
    if (text[begin] != '[')
      return {begin, begin, table_name + "." + line + "\n"};  // table of dotted keys: "joint.length_mm = 1"
    const std::size_t at = std::min(text.find('\n', begin), text.size());
    return {at, at, "\n" + line};
  }
  std::string header;
  if (std::find(new_tables.begin(), new_tables.end(), table_name) == new_tables.end()) {
    new_tables.push_back(table_name);
    const bool ends_with_line = text.empty() || text.back() == '\n';
    header = (ends_with_line ? "\n[" : "\n\n[") + table_name + "]\n";
  }
  return {text.size(), text.size(), header + line + "\n"};
}

/// The file with each former key replaced by its two successors.
std::string without_former_keys(std::string text) {
  const toml::table root = toml::parse(text);
  for (const auto& [table_name, node] : root) {
    const toml::table* table = node.as_table();
    if (table == nullptr) continue;
    for (const auto& [key, value] : *table) {
      const FormerKey* former = find_former_key(std::string(table_name.str()) + "." + std::string(key.str()));
      if (former == nullptr) continue;
      const std::size_t begin = offset_of(text, key.source().begin);
      const std::size_t value_begin = offset_of(text, value.source().begin), end = offset_of(text, value.source().end);
      const std::string written = text.substr(value_begin, end - value_begin);
      const std::size_t prefix = table_name.str().size() + 1;
      // In "table.key = 1" the table's name stands before the first key, and the second key requires it as well.
      const bool is_dotted = begin > 0 && text[begin - 1] == '.';
      const std::string first_key(former->now[0].substr(prefix));
      const std::string second_key(former->now[1].substr(is_dotted ? 0 : prefix));
      const std::string both =
          first_key + " = " + written + (table->is_inline() ? ", " : "\n") + second_key + " = " + written;
      // Parses the new text, because the replacement shifts all later positions.
      return without_former_keys(text.replace(begin, end - begin, both));
    }
  }
  return text;
}

}  // namespace

std::string edit_values(std::string_view as_written, const std::vector<ValueEdit>& edits) {
  const std::string text = without_former_keys(std::string(as_written));
  const toml::table root = toml::parse(text);
  const LengthUnit units = units_of(root);
  std::vector<Replacement> replacements;
  std::vector<std::string> new_tables, new_pairs;
  // Groups the keys of a new table.
  std::vector<ValueEdit> ordered = edits;
  std::stable_sort(ordered.begin(), ordered.end(), [](const ValueEdit& a, const ValueEdit& b) {
    return a.key.substr(0, a.key.find('.')) < b.key.substr(0, b.key.find('.'));
  });
  for (const ValueEdit& edit : ordered) {
    const auto key = find_number_key(edit.key);
    demand(key.has_value(), "edit of " + edit.key);
    const Field& field = *key->field;
    if (const toml::node* node = written_node(root, *key)) {
      replacements.push_back({offset_of(text, node->source().begin), offset_of(text, node->source().end),
                              new_number_text(field, edit.value, units)});
    } else if (field.kind == FieldKind::number) {
      replacements.push_back(new_line(text, root, field, new_number_text(field, edit.value, units), new_tables));
    } else if (const std::string pair = key->field->name();
               std::find(new_pairs.begin(), new_pairs.end(), pair) == new_pairs.end()) {
      new_pairs.push_back(pair);
      const DeclaredMechanism edited = edited_numbers(root, edits);
      const std::string both = "[" + new_number_text(field, field.get(edited, 0), units) + ", " +
                               new_number_text(field, field.get(edited, 1), units) + "]";
      replacements.push_back(new_line(text, root, field, both, new_tables));
    }
  }
  std::stable_sort(replacements.begin(), replacements.end(),
                   [](const Replacement& a, const Replacement& b) { return a.begin < b.begin; });
  std::string edited;
  std::size_t from = 0;
  for (const Replacement& replacement : replacements) {
    edited.append(text, from, replacement.begin - from);
    edited += replacement.text;
    from = replacement.end;
  }
  edited.append(text, from);
  return edited;
}

}  // namespace fusee
