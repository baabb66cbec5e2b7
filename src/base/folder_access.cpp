#include "base/folder_access.h"

#include <algorithm>

namespace fusee {

std::optional<std::vector<std::string>> files_in(const std::filesystem::path& path, const FileAccess& files) {
  namespace fs = std::filesystem;
  if (const auto* const own = dynamic_cast<const FolderAccess*>(&files)) return own->files_in(path);
  std::error_code error;
  if (!fs::is_directory(path, error)) return std::nullopt;
  std::vector<std::string> names;
  for (fs::directory_iterator entry(path, error); !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) names.push_back(entry->path().filename().string());
  }
  if (error) throw InputError(path.string(), "cannot be read: " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace fusee
