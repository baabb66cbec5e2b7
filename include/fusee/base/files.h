/// \file
/// Reading files of any size and kind without harm, and leaving outputs whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/base/file_access.h"

namespace fusee {

/// An input of the run, in blocks: as ReadRequest says, through the FileAccess that there is.
void read_blocks(const ReadRequest& request, const TakeBlock& take);
/// The bytes of a regular file that is an input. InputError when it is missing, a directory, unreadable, or larger than
/// `limit` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t limit);
/// The same of what fusee itself wrote, now or earlier: no input.
std::string read_output(const std::filesystem::path& path, std::size_t limit);

/// The system's folder for temporary files. OutputError where TMPDIR names none.
std::filesystem::path temporary_folder();

/// SHA-256 of `bytes`, 64 lower-case hex digits.
std::string sha256(std::string_view bytes);

class Staging;

/// One file to be left behind: its name inside the output folder, or "folder/name" within that, and its bytes.
struct OutputFile {
  std::string name;
  std::string bytes;
};

/// A set of files that appears in `folder` whole or not at all.
///
/// stage() writes the files into a private folder beside the place, publish() flushes them to disk and makes that
/// folder take the place of the earlier one, with whatever else the earlier one held. The destructor removes what was
/// staged and not published, and the folders made for it. A kill at any moment leaves the old set or the new one; what
/// it left aside is put back or removed by the next publish() into that folder. In a folder that cannot be renamed (the
/// process stands in it, it is a mount point, of another owner) files are replaced one by one, between the removal of
/// manifest.json and its return: a folder without it, after a kill, holds no set.
///
/// Which files are ours? A folder that fusee wrote holds a manifest.json naming its outputs with their SHA-256. claim()
/// and publish() throw OutputError when publishing would overwrite a file that is not named there, or whose bytes were
/// changed since, unless `force`. A manifest that cannot be read is somebody else's file.
class OutputFolder {
 public:
  /// Changes nothing on the disk.
  OutputFolder(std::filesystem::path folder, bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// True when the folder already holds a manifest of an earlier run of fusee.
  bool has_earlier_run() const { return !ours_.empty(); }
  /// Throws OutputError, naming all of them, when some of `names` may not be overwritten (see above) or the folder
  /// cannot be written. Writes nothing.
  void claim(const std::vector<std::string>& names);
  void stage(const OutputFile& file);
  /// Where a staged file lies before it is published.
  std::filesystem::path staged_path(const std::string& name) const;
  /// Publishing will remove those of `names` that an earlier run wrote, that nobody changed since, and that this run
  /// did not write: they would be taken for this run's.
  void withdraw(const std::vector<std::string>& names);
  /// Where a rename fails, what was renamed before it is put back. `notes` receives what was put back or ignored of
  /// killed runs.
  void publish(std::vector<Diagnostic>& notes);
  /// Removes what is staged and the folders made for it from the disk, and nothing else: an interrupted program leaves
  /// while other threads still ask where their files are.
  void discard() const;

 private:
  void learn_ours();
  void open_staging();
  bool is_obsolete(const std::filesystem::path& folder, const std::string& name) const;
  std::set<std::string> subfolders() const;
  void remove_empty_subfolders() const;
  bool link_others() const;
  bool publish_as_folder(std::vector<Diagnostic>& notes);
  void publish_one_by_one();

  std::filesystem::path folder_;  ///< as it was named
  std::filesystem::path place_;   ///< the same from the root, without links and dots
  bool force_;
  /// What earlier runs of fusee wrote here, their manifests too: name and SHA-256.
  std::set<std::pair<std::string, std::string>> ours_;
  std::vector<std::string> staged_;
  std::vector<std::string> withdrawn_;
  std::unique_ptr<Staging> staging_;
};

/// Writes one file beside its place and renames it there. OutputError when it exists (unless `force`) or cannot be
/// written. A symbolic link is followed; what is no regular file is never replaced.
void write_file(const std::filesystem::path& path, std::string_view bytes, bool force);

}  // namespace fusee
