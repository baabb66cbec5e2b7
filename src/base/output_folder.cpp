#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/leftovers.h"
#include "base/staging.h"
#include "fusee/base.h"

// Atomic publishing of a set of files rests on one system call that replaces a folder:
// 1. The new files are staged in a private folder next to the output folder.
// 2. Other entries of the earlier folder get hard links in the staging folder.
// 3. Both folders are exchanged. Without an exchange call, the earlier folder is first renamed aside.
// 4. Entries without hard links, folders above all, are moved across.
// A folder that cannot be renamed (the current folder, a mount point, another owner's) has its files replaced one by
// one. The manifest is removed first and written last. leftovers.h describes the recovery from a kill.

namespace fusee {
namespace {

namespace fs = std::filesystem;

/// Throws OutputError when no file can be made in the deepest existing part of `folder`.
void demand_writable(fs::path folder) {
  while (!entry_exists(folder) && folder.has_parent_path() && folder != folder.parent_path())
    folder = folder.parent_path();
  const fs::path existing = entry_exists(folder) ? folder : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(existing, error))
    throw OutputError(existing.string() + " is not a folder", "choose another folder with -o");
  if (::access(existing.c_str(), W_OK | X_OK) != 0) fail_output("cannot write in", existing, errno);
}

/// True when the folder has extended attributes that a new folder would lack. Security labels are set anew by the
/// system.
bool has_attributes(const fs::path& folder) {
  constexpr std::string_view k_security = "security.";
  std::string names(4096, '\0');  // each name ends with '\0'
  const ssize_t size = ::llistxattr(folder.c_str(), names.data(), names.size());
  if (size < 0) return errno == ERANGE;
  for (std::size_t at = 0; at < static_cast<std::size_t>(size); at = names.find('\0', at) + 1)
    if (names.compare(at, k_security.size(), k_security) != 0) return true;
  return false;
}

/// True when another folder can take the place of this one and all its entries can be moved there.
bool is_replaceable(const fs::path& folder) {
  struct stat status {};
  struct stat above {};
  if (::lstat(folder.c_str(), &status) != 0 || ::lstat(folder.parent_path().c_str(), &above) != 0) return false;
  if (!S_ISDIR(status.st_mode) || status.st_dev != above.st_dev || status.st_uid != ::geteuid()) return false;
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const bool is_current = std::mismatch(folder.begin(), folder.end(), here.begin(), here.end()).first == folder.end();
  if (error || is_current || has_attributes(folder)) return false;
  for (const std::string& name : names_in(folder)) {
    const fs::path entry = folder / name;
    struct stat inner {};
    if (::lstat(entry.c_str(), &inner) != 0) return false;
    if (S_ISDIR(inner.st_mode) && (inner.st_dev != status.st_dev || ::access(entry.c_str(), W_OK | X_OK) != 0))
      return false;
  }
  return true;
}

bool set_rights(const fs::path& folder, const fs::path& like) {
  struct stat status {};
  return ::lstat(like.c_str(), &status) == 0 && ::chown(folder.c_str(), static_cast<uid_t>(-1), status.st_gid) == 0 &&
         ::chmod(folder.c_str(), status.st_mode & 07777) == 0;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_plain(const std::string& name) {
  return !name.empty() && name.front() != '.' && name.find('/') == std::string::npos;
}

/// True for a file of the folder itself, or of a direct subfolder.
bool is_output_name(const std::string& name) {
  const auto slash = name.find('/');
  return slash == std::string::npos ? is_plain(name)
                                    : is_plain(name.substr(0, slash)) && is_plain(name.substr(slash + 1));
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, bool force, const RunContext& context)
    : folder_(folder.empty() ? "." : std::move(folder)),
      place_(place_of(folder_)),
      force_(force),
      context_(context.without_progress()),
      on_stop_(context_.stop, [this] { discard(); }) {
  context_.files->will_write(folder_);
  find_own_files();
}

// The staging folder lies beside a folder that is never made: a folder of that fixed name could belong to another
// user.
OutputFolder::OutputFolder(const RunContext& context)
    : folder_(temporary_folder() / "fusee-dry-run"),
      place_(folder_),
      force_(true),
      context_(context.without_progress()),
      on_stop_(context_.stop, [this] { discard(); }) {
  if (::access(folder_.parent_path().c_str(), W_OK | X_OK) != 0)
    throw OutputError("the temporary folder cannot be written: " + folder_.string(),
                      "set TMPDIR to a folder that you may write to");
  const std::lock_guard lock(guard_);
  staging_ = std::make_unique<Staging>(place_, StagingSite::beside);
}

OutputFolder OutputFolder::temporary(const RunContext& context) { return OutputFolder(context); }

OutputFolder::~OutputFolder() = default;

/// Throws OutputError when something other than a folder has the name of an output subfolder. Links are not followed.
void OutputFolder::demand_subfolder(const fs::path& folder) const {
  if (!entry_exists(folder) || fs::is_directory(fs::symlink_status(folder))) return;
  report_obstacle(folder);
  throw OutputError(folder.string() + " is in the way and is not a folder",
                    "move it away, or choose another folder with -o");
}

void OutputFolder::find_own_files() {
  add_written_files(place_, own_files_);
  add_files_aside(place_, own_files_);
}

void OutputFolder::claim(const std::vector<std::string>& names) {
  demand_writable(folder_);
  std::vector<std::string> foreign, changed;
  const auto all_are_ours = [&] {
    find_own_files();
    foreign.clear();
    changed.clear();
    for (const std::string& name : names) {
      const fs::path target = folder_ / name;
      if (name.find('/') != std::string::npos) demand_subfolder(target.parent_path());
      if (!entry_exists(target)) continue;
      if (!fs::is_regular_file(fs::symlink_status(target))) {
        report_obstacle(target);
        throw OutputError(target.string() + " is in the way and is not a regular file",
                          "move it away, or choose another folder with -o");
      }
      if (force_ || is_unchanged(own_files_, folder_, name)) continue;
      const auto listed = own_files_.lower_bound({name, ""});
      (listed != own_files_.end() && listed->first == name ? changed : foreign).push_back(name);
    }
    return foreign.empty() && changed.empty();
  };
  // Another run may publish after this one reads the manifest and before it compares the files. The next pass reads the
  // new manifest.
  constexpr int k_passes = 3;
  for (int pass = 0; pass < k_passes; ++pass)
    if (all_are_ours()) return;
  for (const std::string& name : foreign) report_obstacle(folder_ / name);
  std::string message = folder_.string() + " holds ";
  if (!foreign.empty()) message += fmt::format("files that fusee did not write: {}", fmt::join(foreign, ", "));
  if (!changed.empty())
    message += fmt::format("{}files that were changed after fusee wrote them: {}", foreign.empty() ? "" : "; and ",
                           fmt::join(changed, ", "));
  throw OutputError(message, "choose another folder with -o, or overwrite them with --force");
}

void OutputFolder::discard() const {
  const std::lock_guard lock(guard_);
  if (staging_) staging_->remove();
}

void OutputFolder::stage(const OutputFile& file) {
  demand(is_output_name(file.name), "output name " + file.name);
  const std::lock_guard lock(guard_);
  context_.throw_if_stopped();
  if (!staging_) open_staging();
  demand(!contains(staged_, file.name), "staged twice: " + file.name);
  staged_.push_back(file.name);
  if (!make_subfolder(staging_->path(), file.name)) fail_output("cannot write", staging_->path(), errno);
  write_whole(staging_->path() / file.name, file.bytes);
}

/// Stages next to the folder when the folder can be replaced as a whole, otherwise inside it.
void OutputFolder::open_staging() {
  demand_writable(folder_);
  const bool beside =
      !entry_exists(place_) || (is_replaceable(place_) && ::access(place_.parent_path().c_str(), W_OK | X_OK) == 0);
  staging_ = std::make_unique<Staging>(place_, beside ? StagingSite::beside : StagingSite::inside);
}

fs::path OutputFolder::staged_path(const std::string& name) const { return staging_->path() / name; }

void OutputFolder::withdraw(const std::vector<std::string>& names) { withdrawn_ = names; }

/// True for an output of an earlier run that this run withdraws.
bool OutputFolder::is_obsolete(const fs::path& folder, const std::string& name) const {
  return contains(withdrawn_, name) && is_unchanged(own_files_, folder, name);
}

/// Subfolders of earlier runs and of this one.
std::set<std::string> OutputFolder::subfolders() const {
  Subfolders all = subfolders_of(own_files_);
  for (const std::string& name : staged_) add_subfolder(name, all);
  return all;
}

/// Hard-links the files that are kept into the staging folder. Returns false when one cannot be linked.
bool OutputFolder::link_others() const {
  bool complete = true;
  for (const std::string& name : entries_in(place_, subfolders())) {
    const fs::path entry = place_ / name;
    if (contains(staged_, name) || is_obsolete(place_, name) || fs::is_directory(fs::symlink_status(entry))) continue;
    complete = make_subfolder(staging_->path(), name) &&
               ::link(entry.c_str(), (staging_->path() / name).c_str()) == 0 && complete;
  }
  return complete;
}

/// Publishes by renaming folders. Returns false and changes nothing where that is impossible.
bool OutputFolder::publish_as_folder(std::vector<Diagnostic>& notes) {
  if (staging_->site() == StagingSite::inside) return false;
  const fs::path& staged = staging_->path();
  if (!entry_exists(place_)) {
    flush_all({staged});
    return move_if_free(staged, place_);
  }
  if (!is_replaceable(place_) || !set_rights(staged, place_)) return false;
  const bool linked = link_others();
  flush_all({staged});
  if (!staging_->take_place_of(place_, /*by_exchange=*/linked)) return false;
  // Moves folders, entries without hard links and entries made in the meantime. Another run may have published since,
  // so that old/ holds its set.
  add_written_files(staging_->old(), own_files_);
  const auto obsolete = [this](const std::string& name) { return is_obsolete(staging_->old(), name); };
  if (move_entries(staging_->old(), place_, subfolders(), obsolete) >= 0) {
    staging_->remove_old();
  } else {
    notes.push_back({Severity::warning,
                     {},
                     "other files of " + place_.string() + " could not be moved from " + staging_->old().string(),
                     "move them by hand, or let the next run do so"});
  }
  return true;
}

void OutputFolder::publish_one_by_one() {
  const ReplacementLock lock(place_);
  const fs::path old = staging_->old();
  if (::mkdir(old.c_str(), 0700) != 0) fail_output("cannot write in", place_, errno);
  std::vector<std::string> published;
  const auto demand_done = [&](bool done, const fs::path& target) {
    if (done) return;
    const int code = errno;
    for (const std::string& name : published) ::unlink((place_ / name).c_str());
    remove_empty_subfolders();
    if (move_entries(old, place_, subfolders()) >= 0) staging_->remove_old();
    fail_output("cannot write", target, code);
  };
  // The manifest is removed first and written last: its presence marks a complete set.
  std::vector<std::string> names = entries_in(place_, subfolders());
  std::partition(names.begin(), names.end(), [](const std::string& name) { return name == k_manifest; });
  for (const std::string& name : names) {
    if (!contains(staged_, name) && !is_obsolete(place_, name)) continue;
    demand_done(make_subfolder(old, name), place_ / name);
    demand_done(::rename((place_ / name).c_str(), (old / name).c_str()) == 0 || errno == ENOENT, place_ / name);
  }
  demand_done(staging_->mark_ready(), staging_->path());
  for (const std::string& name : staged_) {
    demand_done(make_subfolder(place_, name) && move_if_free(staging_->path() / name, place_ / name), place_ / name);
    published.push_back(name);
  }
  flush_all({place_});
  staging_->remove_old();
  remove_empty_subfolders();
}

/// Removes subfolders whose files were all withdrawn.
void OutputFolder::remove_empty_subfolders() const {
  for (const std::string& subfolder : subfolders()) ::rmdir((place_ / subfolder).c_str());
}

void OutputFolder::publish(std::vector<Diagnostic>& notes) {
  const std::lock_guard lock(guard_);
  if (!staging_) return;
  context_.throw_if_stopped();
  for (Diagnostic& note : recover_leftovers(place_)) notes.push_back(std::move(note));
  std::stable_partition(staged_.begin(), staged_.end(), [](const std::string& name) { return name != k_manifest; });
  claim(staged_);
  std::vector<fs::path> staged_paths;
  for (const std::string& name : staged_) staged_paths.push_back(staged_path(name));
  for (const std::string& subfolder : subfolders()) {
    if (entry_exists(staged_path(subfolder))) staged_paths.push_back(staged_path(subfolder));
  }
  flush_all(staged_paths);
  for (const std::string& name : staged_) context_.files->will_publish(folder_ / name, staged_path(name));
  if (publish_as_folder(notes)) {
    flush_all({place_.parent_path()});
  } else {
    publish_one_by_one();
  }
  staging_.reset();
  staged_.clear();
}

void write_file(const fs::path& path, std::string_view bytes, bool force, FileAccess& files) {
  files.will_write(path);
  std::error_code error;
  const fs::path target = fs::is_symlink(path) ? fs::weakly_canonical(path, error) : path;
  const bool is_file = fs::is_regular_file(fs::symlink_status(target));
  if (entry_exists(target) && !(force && is_file)) {
    files.in_the_way(path);
    if (!is_file) throw OutputError(path.string() + " exists and is not a regular file", "choose another name");
    throw OutputError(path.string() + " exists", "choose another name, or overwrite it with --force");
  }
  const fs::path name = target.filename();
  if (name.empty() || name == "." || name == "..")
    throw OutputError(path.string() + " names no file", "add a file name");
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  demand_writable(folder);
  remove_staged_leftovers(target);
  const Staging staging(target, StagingSite::beside);
  const fs::path staged = staging.path() / "file";
  write_whole(staged, bytes);
  flush_all({staged});
  if (::rename(staged.c_str(), target.c_str()) != 0) fail_output("cannot write", target, errno);
  flush_all({folder});
  files.will_publish(path, target);
}

}  // namespace fusee
