/// \file
/// Internal: the private folder in which new files wait until they take their place, and the file operations of
/// publishing.
#pragma once

#include <fcntl.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/descriptor.h"

namespace fusee {

/// OutputError: "<what> <path>: <meaning of the code>", with a hint where one is known.
[[noreturn]] void fail_output(const std::string& what, const std::filesystem::path& path, int code);

/// True when `path` itself exists, whatever it is (a dangling link too).
bool stands(const std::filesystem::path& path);

/// `folder` from the root, without links, dots and a slash at its end.
std::filesystem::path place_of(const std::filesystem::path& folder);

/// Makes a new file. OutputError when it exists or its bytes do not get there; a short write is no success.
void write_whole(const std::filesystem::path& path, std::string_view bytes);

/// Flushes files and folders to the disk, together: fewer waits than one after another.
void flush_all(const std::vector<std::filesystem::path>& paths);

/// Names in a folder; empty when it cannot be read.
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// Renames `from` to `to`, each seen from an open folder, unless something stands there; false with errno.
bool move_if_free(const std::filesystem::path& from, const std::filesystem::path& to, int from_folder = AT_FDCWD,
                  int to_folder = AT_FDCWD);

/// A staging folder lies beside the place (a folder or a file) that it is made for, or inside it.
enum class StagingSite { beside, inside };

/// The private folder of one run: `.fusee-<process>-<key>-XXXXXX`, mode 0700, locked while the run lives. The key is
/// derived from the name of the place, so that the next run into this place finds what a killed one left
/// (leftovers.h). It holds
///   new/       the new files
///   old/       what stood in the place: the earlier folder, or those of its files that are replaced
///   ready/     the new files, once all earlier ones are in old/ (files replaced one by one)
///   obsolete/  earlier files that are being removed
/// The destructor leaves it for the next run while it holds old/, and removes it otherwise, with the folders that were
/// made above it and are still empty.
class Staging {
 public:
  /// Makes the folders above it that are missing too. OutputError when one cannot be made.
  Staging(const std::filesystem::path& place, StagingSite site);
  ~Staging() { remove(); }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  StagingSite site() const { return site_; }
  /// Of the new files.
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path old() const { return root_ / "old"; }
  /// As the destructor does; path() stays what it was.
  void remove() const;
  /// Removes the earlier files.
  void remove_old() const;

  /// The new files become `place`, and the folder that stood there becomes old(): by one exchange, or, where the
  /// system has none or `by_exchange` is false, by two renames. False, with nothing changed, where neither is possible.
  bool take_place_of(const std::filesystem::path& place, bool by_exchange);
  /// Marks the earlier files as complete in old/: from now on a killed run is completed, no longer undone.
  bool mark_ready();

 private:
  explicit Staging(StagingSite site) : site_(site) {}  ///< so that what the other has made is removed when it throws

  std::filesystem::path root_, path_;
  std::vector<std::filesystem::path> made_;  ///< above it, innermost first
  StagingSite site_;
  Descriptor lock_{-1};
};

/// The part of a staging folder's name that identifies its place: 8 hex digits.
std::string staging_key(const std::filesystem::path& place, StagingSite site);
/// The folder that holds the staging folders of a place.
std::filesystem::path staging_ground(const std::filesystem::path& place, StagingSite site);

/// While it lives no other run of this user replaces files one by one in `folder`. Its lock file can be opened by this
/// user alone; where it cannot be made there is no lock.
class ReplacementLock {
 public:
  /// Waits for the run that holds it; OutputError after a minute.
  explicit ReplacementLock(const std::filesystem::path& folder);
  ~ReplacementLock();
  ReplacementLock(const ReplacementLock&) = delete;
  ReplacementLock& operator=(const ReplacementLock&) = delete;

 private:
  std::filesystem::path path_;
  Descriptor file_{-1};
};

}  // namespace fusee
