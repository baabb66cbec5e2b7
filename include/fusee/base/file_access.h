/// \file
/// The one way by which a run reads what it was given and leaves what it makes, so that both can be watched, or taken
/// from and kept to another place than the disk: a bundle of a run is recorded and replayed so.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string_view>

namespace fusee {

using TakeBlock = std::function<void(std::string_view block)>;

/// The bytes of a file in blocks, to its end. InputError when it is missing, a directory, no regular file (a pipe is as
/// good, with `pipes`), unreadable, or larger than `limit` bytes.
struct ReadRequest {
  std::filesystem::path path;
  std::size_t limit = 0;
  bool pipes = false;
};

/// While one lives all inputs of this process are read through it, and it sees what is written. They nest.
class FileAccess {
 public:
  FileAccess();
  virtual ~FileAccess();
  FileAccess(const FileAccess&) = delete;
  FileAccess& operator=(const FileAccess&) = delete;

  /// Throws InputError; what `take` throws goes through.
  virtual void read(const ReadRequest& request, const TakeBlock& take) = 0;
  /// Before anything is written at `place`, a file or a folder. What it throws stops that.
  virtual void will_write(const std::filesystem::path& place) = 0;
  /// What stands where something should be written, and is not ours to replace: the run ends with OutputError.
  virtual void in_the_way(const std::filesystem::path&) {}
  /// A file that is left there, once all of its set are whole.
  virtual void wrote(const std::filesystem::path& name, std::string_view bytes) = 0;

  /// The one that was made last; null when there is none, and the disk is all there is.
  static FileAccess* current();

 private:
  FileAccess* outer_;
};

/// From the disk, without the FileAccess that there is.
void read_from_disk(const ReadRequest& request, const TakeBlock& take);

}  // namespace fusee
