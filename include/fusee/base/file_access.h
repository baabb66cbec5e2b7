/// \file
/// Through it a run reads its inputs and reports its outputs. Bundles of a run are recorded and replayed with it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string_view>

namespace fusee {

using TakeBlock = std::function<void(std::string_view block)>;

/// Request for the bytes of one file, in blocks. Throws InputError when the file is missing, a directory, unreadable,
/// larger than `limit` bytes, or not a regular file. Pipes are accepted with `pipes`.
struct ReadRequest {
  std::filesystem::path path;
  std::size_t limit = 0;
  bool pipes = false;
};

/// This class reads from the disk and ignores reports. One thread at a time uses an object of a derived class.
class FileAccess {
 public:
  FileAccess() = default;
  virtual ~FileAccess() = default;
  FileAccess(const FileAccess&) = delete;
  FileAccess& operator=(const FileAccess&) = delete;

  /// Throws InputError. Exceptions of `take` pass through.
  virtual void read(const ReadRequest& request, const TakeBlock& take);
  /// Called before anything is written at `place`, a file or a folder. An exception prevents the writing.
  virtual void will_write(const std::filesystem::path&) {}
  /// Called for an existing entry that must not be replaced. The run then ends with OutputError.
  virtual void in_the_way(const std::filesystem::path&) {}
  /// Called for each file of a set that is complete and is now put in place, which no request to stop prevents.
  /// `bytes_at`: the file that has the bytes at this moment.
  virtual void will_publish(const std::filesystem::path& /*name*/, const std::filesystem::path& /*bytes_at*/) {}
  /// True if the run is recorded or replayed: it must then depend on nothing but what it reads through this object.
  virtual bool is_bundled() const { return false; }
};

/// The files of the disk. The object has no state.
FileAccess& disk();
/// As disk().read().
void read_from_disk(const ReadRequest& request, const TakeBlock& take);

}  // namespace fusee
