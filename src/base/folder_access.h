/// \file
/// Internal: files in a folder, as a run sees them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"

namespace fusee {

/// Beside FileAccess for those that have folders of their own, such as a bundle.
class FolderAccess {
 public:
  virtual ~FolderAccess() = default;
  virtual std::optional<std::vector<std::string>> files_in(const std::filesystem::path& folder) const = 0;
};

/// Names of the files in a folder, sorted, without those in its subfolders; nothing if `path` is no folder. On the disk
/// unless `files` is a FolderAccess. Throws InputError.
std::optional<std::vector<std::string>> files_in(const std::filesystem::path& path, const FileAccess& files);

}  // namespace fusee
