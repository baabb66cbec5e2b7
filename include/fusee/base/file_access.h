/// \file
/// Hook through which a run reads its inputs and announces its outputs. Bundles of a run are recorded and replayed with
/// it.
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

/// While an object lives, this process reads all inputs through it and reports all outputs to it. Objects nest.
class FileAccess {
 public:
  FileAccess();
  virtual ~FileAccess();
  FileAccess(const FileAccess&) = delete;
  FileAccess& operator=(const FileAccess&) = delete;

  /// Throws InputError. Exceptions of `take` pass through.
  virtual void read(const ReadRequest& request, const TakeBlock& take) = 0;
  /// Called before anything is written at `place`, a file or a folder. An exception prevents the writing.
  virtual void will_write(const std::filesystem::path& place) = 0;
  /// Called for an existing entry that must not be replaced. The run then ends with OutputError.
  virtual void in_the_way(const std::filesystem::path&) {}
  /// Called for each published file, once its whole set is in place.
  virtual void wrote(const std::filesystem::path& name, std::string_view bytes) = 0;

  /// The object made last; null when there is none, and files are then read from the disk.
  static FileAccess* current();

 private:
  FileAccess* outer_;
};

/// Reads from the disk and bypasses the current FileAccess.
void read_from_disk(const ReadRequest& request, const TakeBlock& take);

}  // namespace fusee
