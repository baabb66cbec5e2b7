#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/leftovers.h"
#include "base/staging.h"
#include "fusee/base/diagnostics.h"
#include "fusee/base/files.h"

// A set of files appears at once because one call of the system replaces a folder. The new files are staged in a
// private folder beside the place; other entries of the earlier folder get second names (hard links) there; both
// folders are exchanged; what has no second name, a folder above all, is moved across afterwards. Where the system has
// no exchange, the earlier folder is renamed aside first. A folder that cannot be renamed (this process stands in it,
// it is a mount point or somebody else's) has its files replaced one by one, between a manifest that goes first and one
// that comes last. leftovers.h has the way back from a kill.

namespace fusee {
namespace {

namespace fs = std::filesystem;

void tell_in_the_way(const fs::path& path) {
  if (FileAccess* access = FileAccess::current()) access->in_the_way(path);
}

/// OutputError where no file can be made in the deepest part of `folder` that exists.
void demand_ground(fs::path folder) {
  while (!stands(folder) && folder.has_parent_path() && folder != folder.parent_path()) folder = folder.parent_path();
  const fs::path ground = stands(folder) ? folder : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(ground, error))
    throw OutputError(ground.string() + " is not a folder", "choose another folder with -o");
  if (::access(ground.c_str(), W_OK | X_OK) != 0) fail_output("cannot write in", ground, errno);
}

/// OutputError where something else stands in the place of a folder of outputs; a link is never followed there.
void demand_subfolder(const fs::path& folder) {
  if (!stands(folder) || fs::is_directory(fs::symlink_status(folder))) return;
  tell_in_the_way(folder);
  throw OutputError(folder.string() + " is in the way and is not a folder",
                    "move it away, or choose another folder with -o");
}

/// Rights that a new folder would not have by itself. What a security module labels is labelled anew.
bool has_attributes(const fs::path& folder) {
  std::string names(4096, '\0');
  const ssize_t size = ::llistxattr(folder.c_str(), names.data(), names.size());
  if (size < 0) return errno == ERANGE;
  for (std::size_t at = 0; at < static_cast<std::size_t>(size); at = names.find('\0', at) + 1)
    if (names.compare(at, 9, "security.") != 0) return true;
  return false;
}

/// True when another folder may take the place of this one, and everything in it can be moved there.
bool is_replaceable(const fs::path& folder) {
  struct stat status {};
  struct stat above {};
  if (::lstat(folder.c_str(), &status) != 0 || ::lstat(folder.parent_path().c_str(), &above) != 0) return false;
  if (!S_ISDIR(status.st_mode) || status.st_dev != above.st_dev || status.st_uid != ::geteuid()) return false;
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const bool stands_in_it = std::mismatch(folder.begin(), folder.end(), here.begin(), here.end()).first == folder.end();
  if (error || stands_in_it || has_attributes(folder)) return false;
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

/// A file of the folder itself, or of a folder in it.
bool is_output_name(const std::string& name) {
  const auto slash = name.find('/');
  return slash == std::string::npos ? is_plain(name)
                                    : is_plain(name.substr(0, slash)) && is_plain(name.substr(slash + 1));
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, bool force)
    : folder_(folder.empty() ? "." : std::move(folder)), place_(place_of(folder_)), force_(force) {
  if (FileAccess* access = FileAccess::current()) access->will_write(folder_);
  learn_ours();
}

OutputFolder::~OutputFolder() = default;

void OutputFolder::learn_ours() {
  add_written_files(place_, ours_);
  add_files_aside(place_, ours_);
}

void OutputFolder::claim(const std::vector<std::string>& names) {
  demand_ground(folder_);
  std::vector<std::string> foreign, changed;
  const auto all_are_ours = [&] {
    learn_ours();
    foreign.clear();
    changed.clear();
    for (const std::string& name : names) {
      const fs::path target = folder_ / name;
      if (name.find('/') != std::string::npos) demand_subfolder(target.parent_path());
      if (!stands(target)) continue;
      if (!fs::is_regular_file(fs::symlink_status(target))) {
        tell_in_the_way(target);
        throw OutputError(target.string() + " is in the way and is not a regular file",
                          "move it away, or choose another folder with -o");
      }
      if (force_ || is_unchanged(ours_, folder_, name)) continue;
      const auto listed = ours_.lower_bound({name, ""});
      (listed != ours_.end() && listed->first == name ? changed : foreign).push_back(name);
    }
    return foreign.empty() && changed.empty();
  };
  // Another run may publish between the look at its manifest and the look at its files: its manifest is known then.
  if (all_are_ours() || all_are_ours() || all_are_ours()) return;
  for (const std::string& name : foreign) tell_in_the_way(folder_ / name);
  std::string message = folder_.string() + " holds ";
  if (!foreign.empty()) message += fmt::format("files that fusee did not write: {}", fmt::join(foreign, ", "));
  if (!changed.empty())
    message += fmt::format("{}files that were changed after fusee wrote them: {}", foreign.empty() ? "" : "; and ",
                           fmt::join(changed, ", "));
  throw OutputError(message, "choose another folder with -o, or overwrite them with --force");
}

void OutputFolder::discard() const {
  if (staging_) staging_->remove();
}

void OutputFolder::stage(const OutputFile& file) {
  demand(is_output_name(file.name), "output name " + file.name);
  if (!staging_) open_staging();
  demand(!contains(staged_, file.name), "staged twice: " + file.name);
  staged_.push_back(file.name);
  if (!make_subfolder(staging_->path(), file.name)) fail_output("cannot write", staging_->path(), errno);
  write_whole(staging_->path() / file.name, file.bytes);
}

/// Beside the folder where it can be replaced as a whole.
void OutputFolder::open_staging() {
  demand_ground(folder_);
  const bool beside =
      !stands(place_) || (is_replaceable(place_) && ::access(place_.parent_path().c_str(), W_OK | X_OK) == 0);
  staging_ = std::make_unique<Staging>(place_, beside ? StagingSite::beside : StagingSite::inside);
}

fs::path OutputFolder::staged_path(const std::string& name) const { return staging_->path() / name; }

void OutputFolder::withdraw(const std::vector<std::string>& names) { withdrawn_ = names; }

/// True for a file of an earlier run that this one does not keep.
bool OutputFolder::is_obsolete(const fs::path& folder, const std::string& name) const {
  return contains(withdrawn_, name) && is_unchanged(ours_, folder, name);
}

/// Subfolders of earlier runs and of this one.
std::set<std::string> OutputFolder::subfolders() const {
  Subfolders all = subfolders_of(ours_);
  for (const std::string& name : staged_) add_subfolder(name, all);
  return all;
}

/// Gives what stays in the folder a second name among the new files; false when something has none.
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

/// By renames of the folder; false, with nothing changed, where that cannot be.
bool OutputFolder::publish_as_folder(std::vector<Diagnostic>& notes) {
  if (staging_->site() == StagingSite::inside) return false;
  const fs::path& made = staging_->path();
  if (!stands(place_)) {
    flush_all({made});
    return move_if_free(made, place_);
  }
  if (!is_replaceable(place_) || !set_rights(made, place_)) return false;
  const bool linked = link_others();
  flush_all({made});
  if (!staging_->take_place_of(place_, /*by_exchange=*/linked)) return false;
  // Of folders, of what has no second name, and of what came since. Another run may have published in between: its set
  // is the earlier one now.
  add_written_files(staging_->old(), ours_);
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
  // The manifest goes first and comes last: where it stands, the set is whole.
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

/// Those whose files were withdrawn.
void OutputFolder::remove_empty_subfolders() const {
  for (const std::string& subfolder : subfolders()) ::rmdir((place_ / subfolder).c_str());
}

void OutputFolder::publish(std::vector<Diagnostic>& notes) {
  if (!staging_) return;
  for (Diagnostic& note : recover_leftovers(place_)) notes.push_back(std::move(note));
  std::stable_partition(staged_.begin(), staged_.end(), [](const std::string& name) { return name != k_manifest; });
  claim(staged_);
  std::vector<fs::path> made;
  for (const std::string& name : staged_) made.push_back(staged_path(name));
  for (const std::string& subfolder : subfolders()) {
    if (stands(staged_path(subfolder))) made.push_back(staged_path(subfolder));
  }
  flush_all(made);
  if (FileAccess* access = FileAccess::current()) {
    for (const std::string& name : staged_)
      access->wrote(folder_ / name, read_output(staged_path(name), k_largest_output));
  }
  if (publish_as_folder(notes)) {
    flush_all({place_.parent_path()});
  } else {
    publish_one_by_one();
  }
  staging_.reset();
  staged_.clear();
}

void write_file(const fs::path& path, std::string_view bytes, bool force) {
  FileAccess* access = FileAccess::current();
  if (access != nullptr) access->will_write(path);
  std::error_code error;
  const fs::path target = fs::is_symlink(path) ? fs::weakly_canonical(path, error) : path;
  const bool is_file = fs::is_regular_file(fs::symlink_status(target));
  if (stands(target) && !(force && is_file)) {
    tell_in_the_way(path);
    if (!is_file) throw OutputError(path.string() + " exists and is not a regular file", "choose another name");
    throw OutputError(path.string() + " exists", "choose another name, or overwrite it with --force");
  }
  const fs::path name = target.filename();
  if (name.empty() || name == "." || name == "..")
    throw OutputError(path.string() + " names no file", "add a file name");
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  demand_ground(folder);
  remove_staged_leftovers(target);
  const Staging staging(target, StagingSite::beside);
  const fs::path made = staging.path() / "file";
  write_whole(made, bytes);
  flush_all({made});
  if (::rename(made.c_str(), target.c_str()) != 0) fail_output("cannot write", target, errno);
  flush_all({folder});
  if (access != nullptr) access->wrote(path, bytes);
}

}  // namespace fusee
