/// \file
/// Internal: the hidden folder in which outputs are written before they are renamed into place, and what a killed run
/// left of one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/file_access.h"

namespace fusee {

/// read_from_disk() without a look at what killed runs left.
void read_as_it_lies(const ReadRequest& request, const TakeBlock& take);
/// Before `file` is read: where a run was killed while it put a set of files in its folder, one by one, the set is made
/// whole. InputError when it cannot be: half of it is of another set.
void end_killed_publishing(const std::filesystem::path& file);

/// OutputError: "<what> <path>: <what the code means>", with a hint where one is known.
[[noreturn]] void fail_output(const std::string& what, const std::filesystem::path& path, int code);

/// True when `path` itself exists, whatever it is (a dangling link too).
bool stands(const std::filesystem::path& path);

/// Makes a new file. OutputError when it exists or its bytes do not get there; a short write is no success.
void write_whole(const std::filesystem::path& path, std::string_view bytes);

/// Flushes files and folders to the disk, together: it takes few turns for all of them where one after another would
/// take one each.
void flush_all(const std::vector<std::filesystem::path>& paths);

/// Folders that are made because they are missing; the destructor removes those that are still empty.
class MissingFolders {
 public:
  MissingFolders() = default;
  ~MissingFolders();
  MissingFolders(const MissingFolders&) = delete;
  MissingFolders& operator=(const MissingFolders&) = delete;
  void make(const std::filesystem::path& folder);
  /// Those that are empty.
  void remove() const;

 private:
  std::vector<std::filesystem::path> made_;  ///< outermost first
};

/// A folder named .fusee-<process>-XXXXXX in `within`, locked while this run lives, removed with all it holds at the
/// end.
class Staging {
 public:
  /// Throws OutputError.
  explicit Staging(const std::filesystem::path& within);
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// From the disk; path() stays what it was.
  void remove() const;
  /// Renames it into another folder of the same file system; false with errno.
  bool move_into(const std::filesystem::path& folder);
  /// Nothing of what now has its name is removed.
  void let_go() { path_.clear(); }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

/// Stagings in `folder` whose run was killed.
std::vector<std::filesystem::path> stale_stagings(const std::filesystem::path& folder);
void remove_stale_stagings(const std::filesystem::path& folder);

/// While it lives no other run of fusee publishes into a folder within `folder`: it waits for the one that does.
class Turn {
 public:
  /// OutputError after a minute.
  explicit Turn(const std::filesystem::path& folder);
  ~Turn();
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  int lock_ = -1;
};

}  // namespace fusee
