#include "pipeline/law_table_copy.h"

#include <algorithm>

#include "fusee/pipeline.h"

namespace fusee::pipeline {
namespace {

constexpr std::size_t k_largest_table = 8 << 20;           // bytes
constexpr std::size_t k_largest_mechanism_file = 1 << 20;  // bytes

/// True if the text alone, without --set, is this mechanism. It may be incomplete: --set may supply a key that it
/// lacks.
bool is_complete(const std::string& text, const MechanismFile& file, FileAccess& files) {
  try {
    const std::filesystem::path folder = std::filesystem::path(file.path).parent_path();
    return parse_mechanism(text, file.path, folder, {}, nullptr, nullptr, files) == file.mechanism;
  } catch (const InputError&) {
    return false;
  }
}

/// The user's text if it describes the mechanism, otherwise a new one.
DeclaredText own_text(const MechanismFile& file, FileAccess& files) {
  if (!file.sha256.empty()) {
    std::string text = read_file(file.path, k_largest_mechanism_file, files);
    if (sha256(text) == file.sha256 && is_complete(text, file, files)) return {std::move(text), false};
  }
  return {write_mechanism(file.mechanism), true};
}

/// The table from which the target motion is read.
template <typename AnyMechanism>
auto& declared_table(AnyMechanism& mechanism) {
  return mechanism.pulley.law == Law::torque ? mechanism.pulley.torque_table : mechanism.pulley.table;
}

std::filesystem::path table_path(const MechanismFile& file) {
  return std::filesystem::path(file.path).parent_path() / std::filesystem::path(declared_table(file.mechanism));
}

/// True if `text`, as a file of `folder`, is a mechanism whose table is the file `table` of that folder.
bool finds_table(const std::string& text, const std::filesystem::path& folder, const std::string& table,
                 FileAccess& files) {
  try {
    const DeclaredMechanism mechanism = parse_mechanism(text, "corrected.toml", folder, {}, nullptr, nullptr, files);
    return declared_table(mechanism) == table;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::optional<std::string> law_table_name(const Mechanism& mechanism) {
  if (mechanism.transmission || (mechanism.pulley.law != Law::table && mechanism.pulley.law != Law::torque))
    return std::nullopt;
  const std::string& table = declared_table(mechanism);
  if (table.empty()) return std::nullopt;
  const std::string name = std::filesystem::path(table).filename().string();
  const std::vector<std::string>& taken = output_names();
  const bool is_taken = name == "compensation.csv" || std::find(taken.begin(), taken.end(), name) != taken.end();
  return is_taken ? "law_" + name : name;
}

OutputFile law_table_copy(const MechanismFile& file, FileAccess& files) {
  return {law_table_name(file.mechanism).value(), read_file(table_path(file), k_largest_table, files)};
}

DeclaredText declared_text(const MechanismFile& file, FileAccess& files) {
  DeclaredText own = own_text(file, files);
  if (law_table_name(file.mechanism)) own.text = with_table_beside(own.text, file, files);
  return own;
}

std::vector<OutputFile> mechanism_files(const MechanismFile& file, FileAccess& files) {
  std::vector<OutputFile> all{{"mechanism.toml", declared_text(file, files).text}};
  if (law_table_name(file.mechanism)) all.push_back(law_table_copy(file, files));
  return all;
}

// The table's name may also occur in a comment or another value. The right occurrence is the one with which the reader
// finds the table in its own folder. A value with escapes does not occur literally: then every key is written anew.
std::string with_table_beside(const std::string& text, const MechanismFile& file, FileAccess& files) {
  const std::string& declared = declared_table(file.mechanism);
  const std::string new_name = law_table_name(file.mechanism).value();
  if (new_name == declared) return text;
  for (std::size_t at = text.find(declared); at != std::string::npos; at = text.find(declared, at + 1)) {
    std::string changed = text;
    changed.replace(at, declared.size(), new_name);
    if (finds_table(changed, table_path(file).parent_path(), new_name, files)) return changed;
  }
  DeclaredMechanism mechanism = file.mechanism;
  declared_table(mechanism) = new_name;
  return write_mechanism(mechanism);
}

}  // namespace fusee::pipeline
