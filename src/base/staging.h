/// \file
/// Internal: the private folder that holds new files until they are published, and the file operations of publishing.
#pragma once

#include <fcntl.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/descriptor.h"

namespace fusee {

/// Throws OutputError: "<failure> <path>: <meaning of errno>", with a hint where one is known.
[[noreturn]] void fail_output(const std::string& failure, const std::filesystem::path& path, int errno_code);

/// True when the entry itself exists, dangling links included.
bool entry_exists(const std::filesystem::path& path);

/// `folder` as an absolute path without links, dots and trailing slash.
std::filesystem::path place_of(const std::filesystem::path& folder);

/// Creates a new file. Throws OutputError when it exists or is not written completely.
void write_whole(const std::filesystem::path& path, std::string_view bytes);

/// Flushes files and folders to the disk concurrently, which takes less time than one after another.
void flush_all(const std::vector<std::filesystem::path>& paths);

/// Names in a folder; empty when the folder cannot be read.
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// Renames `from` to `to`, relative to the given folders, unless `to` exists. Returns false and sets errno on failure.
bool move_if_free(const std::filesystem::path& from, const std::filesystem::path& to, int from_folder = AT_FDCWD,
                  int to_folder = AT_FDCWD);

/// Location of a staging folder: next to the place (a folder or a file) that it serves, or inside it.
enum class StagingSite { beside, inside };

/// The private folder of one run: `.fusee-<process>-<key>-XXXXXX`, mode 0700, locked while the run lives. The key is
/// derived from the name of the place, so that the next run into this place finds the leftovers of a killed one
/// (leftovers.h). The folder holds
///   new/       the new files
///   old/       the earlier folder, or those of its files that are replaced
///   ready/     the new files, once all earlier ones are in old/ (files replaced one by one)
///   obsolete/  earlier files that are being removed
/// The destructor removes the staging folder and the empty folders made above it, unless it holds old/, which the next
/// run needs.
class Staging {
 public:
  /// Makes missing parent folders too. Throws OutputError when one cannot be made.
  Staging(const std::filesystem::path& place, StagingSite site);
  ~Staging() { remove(); }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  StagingSite site() const { return site_; }
  /// The folder of the new files.
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path old() const { return root_ / "old"; }
  /// Removes the folder as the destructor does. path() keeps its value.
  void remove() const;
  /// Removes the earlier files.
  void remove_old() const;

  /// Publishes the new folder as `place` and keeps the earlier folder as old(). Uses one atomic exchange; without
  /// `by_exchange`, or when the system has no exchange, two renames. Returns false and changes nothing when neither
  /// works.
  bool take_place_of(const std::filesystem::path& place, bool by_exchange);
  /// Marks old/ as complete: from now on, recovery completes a killed run instead of undoing it.
  bool mark_ready();

 private:
  /// The public constructor delegates to this one, so that ~Staging() runs when it throws.
  explicit Staging(StagingSite site) : site_(site) {}

  std::filesystem::path root_, path_;
  std::vector<std::filesystem::path> made_;  ///< missing parent folders that this object makes, innermost first
  StagingSite site_;
  Descriptor lock_{-1};
};

/// The part of a staging folder's name that identifies its place: 8 hex digits.
std::string staging_key(const std::filesystem::path& place, StagingSite site);
/// The folder that holds the staging folders of a place.
std::filesystem::path staging_parent(const std::filesystem::path& place, StagingSite site);

/// Excludes other runs of this user that replace files one by one in `folder`. Only this user can open the lock file.
/// If the lock file cannot be made, no run is excluded.
class ReplacementLock {
 public:
  /// Waits for the run that holds the lock. Throws OutputError after a minute.
  explicit ReplacementLock(const std::filesystem::path& folder);
  ~ReplacementLock();
  ReplacementLock(const ReplacementLock&) = delete;
  ReplacementLock& operator=(const ReplacementLock&) = delete;

 private:
  std::filesystem::path path_;
  Descriptor file_{-1};
};

}  // namespace fusee
