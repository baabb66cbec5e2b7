/// \file
/// Reading files of any size and kind without harm, and leaving outputs whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fusee {

/// The bytes of a regular file. InputError when it is missing, a directory, unreadable, or larger than `limit` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t limit);

/// SHA-256 of `bytes`, 64 lower-case hex digits.
std::string sha256(std::string_view bytes);

/// One file to be left behind: its name inside the output folder and its bytes.
struct OutputFile {
  std::string name;
  std::string bytes;
};

/// A set of files that appears in `folder` whole or not at all.
///
/// stage() writes the files (fsync'd) into a hidden folder beside the target; publish() renames each into place;
/// the destructor removes what was staged and not published. A kill at any moment leaves the earlier files whole.
///
/// Whose work is it? A folder that fusee wrote holds a manifest.json naming its outputs with their SHA-256. stage() throws
/// OutputError when publishing would overwrite a file that is not named there, or whose bytes were changed since,
/// unless `force`.
class OutputFolder {
 public:
  OutputFolder(std::filesystem::path folder, bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// True when the folder already holds a manifest of an earlier run of fusee.
  bool has_earlier_run() const;
  /// Throws OutputError when one of `names` may not be overwritten (see above) or the folder cannot be written. Writes nothing.
  void claim(const std::vector<std::string>& names) const;
  void stage(const OutputFile& file);
  /// Where a staged file can be read back before it is published.
  std::filesystem::path staged_path(const std::string& name) const;
  void publish();

 private:
  std::filesystem::path folder_;
  std::filesystem::path staging_;
  bool force_;
  std::vector<std::string> staged_;
};

/// Writes one file beside its place and renames it there. OutputError when it exists (unless `force`) or cannot be written.
void write_file(const std::filesystem::path& path, std::string_view bytes, bool force);

}  // namespace fusee
