/// \file
/// Reading files of any size and kind without harm, and leaving outputs whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <utility>
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
/// stage() writes the files into a hidden folder inside the target; publish() flushes them to disk and renames each into
/// place, manifest.json last; the destructor removes what was staged and not published, and the folders made for it. A
/// kill at any moment leaves the earlier files whole; what a killed run left staged is removed by the next one.
///
/// Whose work is it? A folder that fusee wrote holds a manifest.json naming its outputs with their SHA-256. claim() and
/// stage() throw OutputError when publishing would overwrite a file that is not named there, or whose bytes were changed
/// since, unless `force`. A manifest that cannot be read is somebody else's file.
class OutputFolder {
 public:
  /// Touches nothing yet.
  OutputFolder(std::filesystem::path folder, bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// True when the folder already holds a manifest of an earlier run of fusee.
  bool has_earlier_run() const { return earlier_run_; }
  /// Throws OutputError, naming all of them, when some of `names` may not be overwritten (see above) or the folder
  /// cannot be written. Writes nothing.
  void claim(const std::vector<std::string>& names) const;
  void stage(const OutputFile& file);
  /// Where a staged file can be read back before it is published.
  std::filesystem::path staged_path(const std::string& name) const;
  /// Where a rename fails, what was renamed before it is put back.
  void publish();
  /// After publishing: removes those of `names` that an earlier run wrote, that nobody changed since, and that this run did
  /// not write. They would be taken for this run's.
  void withdraw(const std::vector<std::string>& names) const;

 private:
  void open_staging();
  void close_staging();
  void remove_stale() const;
  void put_back(const std::vector<std::string>& published) const;

  std::filesystem::path folder_;
  std::filesystem::path staging_;
  bool force_;
  bool earlier_run_ = false;
  /// What earlier runs of fusee wrote here: name and SHA-256. A run killed while publishing has its manifest still
  /// staged.
  std::set<std::pair<std::string, std::string>> ours_;
  std::vector<std::string> staged_;
  std::vector<std::string> published_;
  std::vector<std::filesystem::path> made_folders_;  ///< outermost first
  int lock_ = -1;                                    ///< held on the staging folder while this run lives
};

/// Writes one file beside its place and renames it there. OutputError when it exists (unless `force`) or cannot be
/// written. A symbolic link is followed; what is no regular file is never replaced.
void write_file(const std::filesystem::path& path, std::string_view bytes, bool force);

}  // namespace fusee
