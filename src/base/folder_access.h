/// \file
/// Internal: lists the files in a folder, on the disk or in a bundle.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"

namespace fusee {

/// Second base class of a FileAccess that has folders of its own, such as a bundle.
class FolderAccess {
 public:
  virtual ~FolderAccess() = default;
  virtual std::optional<std::vector<std::string>> files_in(const std::filesystem::path& folder) const = 0;
};

/// Sorted names of the files in a folder, without those in its subfolders; nullopt if `path` is no folder. Lists the
/// disk unless `files` is also a FolderAccess. Throws InputError.
std::optional<std::vector<std::string>> files_in(const std::filesystem::path& path, const FileAccess& files);

}  // namespace fusee
