#include "base/written_files.h"

#include "base/json.h"
#include "fusee/base/diagnostics.h"
#include "fusee/base/files.h"

namespace fusee {

namespace fs = std::filesystem;

bool add_written_files(const fs::path& folder, WrittenFiles& written) {
  constexpr std::size_t k_largest_manifest = 16 << 20;
  std::string text;
  try {
    text = read_output(folder / k_manifest, k_largest_manifest);
  } catch (const InputError&) {
    return false;
  }
  const Json manifest = parse_foreign_json(text);
  if (!manifest.is_object() || !manifest.contains("tool") || !manifest.contains("outputs")) return false;
  const Json& tool = manifest["tool"];
  if (!tool.is_string() || tool.get_ref<const std::string&>().rfind("fusee", 0) != 0) return false;
  if (!manifest["outputs"].is_array()) return false;
  for (const Json& output : manifest["outputs"]) {
    if (!output.is_object()) continue;
    const auto file = output.find("file"), hash = output.find("sha256");
    if (file == output.end() || hash == output.end() || !file->is_string() || !hash->is_string()) continue;
    written.emplace(file->get<std::string>(), hash->get<std::string>());
  }
  return true;
}

bool is_unchanged(const WrittenFiles& written, const fs::path& file) {
  if (!fs::is_regular_file(fs::symlink_status(file))) return false;
  try {
    return written.count({file.filename().string(), sha256(read_output(file, k_largest_output))}) != 0;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace fusee
