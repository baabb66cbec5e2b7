/// \file
/// Reading of arbitrary files, and atomic publishing of outputs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/base/file_access.h"
#include "fusee/base/run_context.h"

namespace fusee {

/// The bytes of a regular file. Throws InputError when it is missing, a directory, unreadable, or larger than `limit`
/// bytes. Inputs are read through the FileAccess of the run; files that fusee wrote, from the disk.
std::string read_file(const std::filesystem::path& path, std::size_t limit, FileAccess& files = disk());

/// The system's folder for temporary files. OutputError where TMPDIR names none.
std::filesystem::path temporary_folder();

/// SHA-256 of `bytes`, 64 lower-case hex digits.
std::string sha256(std::string_view bytes);

class Staging;

/// One output: its name inside the output folder, or "folder/name", and its bytes.
struct OutputFile {
  std::string name;
  std::string bytes;
};

/// A set of files that appears in `folder` whole or not at all.
///
/// stage() writes the files into a private folder next to the output folder. publish() flushes them to disk and
/// replaces the earlier folder by the private one, which also receives the unrelated entries of the earlier folder. The
/// destructor removes staged files that were not published, and the folders made for them. So does a request to stop, at
/// once and in the thread that makes it; from then on stage() and publish() throw Stopped. A request during publish() waits
/// until the files are in place. A kill at any moment leaves
/// the old set or the new one; the next publish() into that folder restores or removes what the killed run set aside.
/// Some folders cannot be renamed: the current folder of the process, a mount point, a folder of another owner. There,
/// files are replaced one by one. manifest.json is removed first and written last, so a folder without it after a kill
/// holds no complete set.
///
/// Ownership: a folder that fusee wrote holds a manifest.json that lists its outputs with their SHA-256. claim() and
/// publish() throw OutputError when they would overwrite an unlisted file, or a listed file whose bytes were changed,
/// unless `force`. An unreadable manifest counts as foreign.
class OutputFolder {
 public:
  /// Changes nothing on the disk.
  OutputFolder(std::filesystem::path folder, bool force, const RunContext& context = {});
  /// A folder in the system's temporary folder, for files that are read back and never published. Throws OutputError.
  static OutputFolder temporary(const RunContext& context);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// True when the folder already holds a manifest of an earlier run of fusee.
  bool has_earlier_run() const { return !own_files_.empty(); }
  /// Throws OutputError, naming all of them, when some of `names` may not be overwritten (see above) or the folder
  /// cannot be written. Writes nothing.
  void claim(const std::vector<std::string>& names);
  void stage(const OutputFile& file);
  /// Path of a staged file before it is published.
  std::filesystem::path staged_path(const std::string& name) const;
  /// Marks outputs of an earlier run for removal on publish(). Files that were changed since, or that this run writes,
  /// are kept. Stale outputs would be mistaken for outputs of this run.
  void withdraw(const std::vector<std::string>& names);
  /// Publishes the staged files. If a rename fails, earlier renames are undone. `notes` receives what was restored or
  /// ignored of killed runs.
  void publish(std::vector<Diagnostic>& notes);

 private:
  /// For temporary().
  explicit OutputFolder(const RunContext& context);

  /// Removes staged files and the folders made for them from the disk. Paths stay valid, because other threads may still
  /// call staged_path().
  void discard() const;
  void report_obstacle(const std::filesystem::path& path) const { context_.files->in_the_way(path); }
  void demand_subfolder(const std::filesystem::path& folder) const;
  void find_own_files();
  void open_staging();
  bool is_obsolete(const std::filesystem::path& folder, const std::string& name) const;
  std::set<std::string> subfolders() const;
  void remove_empty_subfolders() const;
  bool link_others() const;
  bool publish_as_folder(std::vector<Diagnostic>& notes);
  void publish_one_by_one();

  std::filesystem::path folder_;  ///< as given by the caller
  std::filesystem::path place_;   ///< absolute, without links and dots
  bool force_;
  /// Name and SHA-256 of all files that earlier runs of fusee wrote here, manifests included.
  std::set<std::pair<std::string, std::string>> own_files_;
  std::vector<std::string> staged_;
  std::vector<std::string> withdrawn_;
  std::unique_ptr<Staging> staging_;
  RunContext context_;
  mutable std::mutex guard_;  ///< held while files are staged, published or discarded
  std::stop_callback<std::function<void()>> on_stop_;
};

/// Writes one file atomically, by a rename. Throws OutputError when the file exists (unless `force`) or cannot be
/// written. A symbolic link is followed. Only regular files are replaced.
void write_file(const std::filesystem::path& path, std::string_view bytes, bool force, FileAccess& files = disk());

}  // namespace fusee
