#include "pipeline/law_table_copy.h"

namespace fusee {
namespace {

constexpr std::size_t k_largest_law = 8 << 20;

std::filesystem::path table_path(const MechanismFile& file) {
  return std::filesystem::path(file.path).parent_path() / std::filesystem::path(file.mechanism.pulley.table);
}

/// Whether `text`, lying in `folder`, is a mechanism whose table lies beside it.
bool has_beside(const std::string& text, const std::filesystem::path& folder, const std::string& table) {
  try {
    return parse_mechanism(text, "corrected.toml", folder).pulley.table == table;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::optional<std::string> law_table_name(const Mechanism& mechanism) {
  if (mechanism.transmission || mechanism.pulley.law != Law::table) return std::nullopt;
  return std::filesystem::path(mechanism.pulley.table).filename().string();
}

OutputFile law_table_copy(const MechanismFile& file) {
  return {law_table_name(file.mechanism).value(), read_file(table_path(file), k_largest_law)};
}

// The same words may stand in a comment or in another value: the one place is that with which the reader finds the
// table in its own folder. A value written with escapes stands nowhere as it reads: then every key is written anew.
std::string with_table_beside(const std::string& text, const MechanismFile& file) {
  const std::string& declared = file.mechanism.pulley.table;
  const std::string beside = law_table_name(file.mechanism).value();
  if (beside == declared) return text;
  for (std::size_t at = text.find(declared); at != std::string::npos; at = text.find(declared, at + 1)) {
    std::string changed = text;
    changed.replace(at, declared.size(), beside);
    if (has_beside(changed, table_path(file).parent_path(), beside)) return changed;
  }
  DeclaredMechanism mechanism = file.mechanism;
  mechanism.pulley.table = beside;
  return write_mechanism(mechanism);
}

}  // namespace fusee
