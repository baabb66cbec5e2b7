#include <fcntl.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/output_list.h"
#include "base/staging.h"
#include "fusee/base/diagnostics.h"
#include "fusee/base/files.h"

// How a set of files appears all at once. No call of the system replaces several files, but one replaces a folder: the
// new folder is made beside the old one, with second names (hard links) for whatever else the old one holds, and both
// change names in one call. Where that cannot be - the folder holds folders, is the one that we stand in, a mount
// point, somebody else's, on a file system without such calls - the files are renamed one by one, after a journal was
// written with which the next run ends what a killed one began, before it reads anything.

namespace fusee {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_manifest = "manifest.json";
constexpr const char* k_journal = ".publishing";
constexpr std::string_view k_backup_prefix = ".earlier-";
/// More than any output of ours; a file beyond it was not written by us.
constexpr std::size_t k_largest_output = std::size_t{4} << 30;
constexpr std::size_t k_largest_manifest = 16 << 20;

using Owned = std::set<std::pair<std::string, std::string>>;

/// Adds what a manifest says fusee wrote. False when it is no manifest of fusee.
bool read_manifest(const fs::path& path, Owned& owned) {
  std::string text;
  try {
    text = read_output(path, k_largest_manifest);
  } catch (const InputError&) {
    return false;
  }
  const Json manifest = parse_foreign_json(text);
  if (!manifest.is_object() || !manifest.contains("tool") || !manifest.contains("outputs")) return false;
  const Json& tool = manifest["tool"];
  if (!tool.is_string() || tool.get_ref<const std::string&>().rfind("fusee", 0) != 0) return false;
  if (!manifest["outputs"].is_array()) return false;
  for (const Json& output : manifest["outputs"]) {
    if (!output.is_object()) continue;
    const auto file = output.find("file"), hash = output.find("sha256");
    if (file == output.end() || hash == output.end() || !file->is_string() || !hash->is_string()) continue;
    owned.emplace(file->get<std::string>(), hash->get<std::string>());
  }
  return true;
}

void tell_in_the_way(const fs::path& path) {
  if (FileAccess* access = FileAccess::current()) access->in_the_way(path);
}

/// The deepest part of `path` that exists.
fs::path standing_ancestor(fs::path path) {
  while (!stands(path) && path.has_parent_path() && path != path.parent_path()) path = path.parent_path();
  return stands(path) ? path : fs::path(".");
}

/// `folder` from the root, without links, dots and a slash at its end.
fs::path place_of(const fs::path& folder) {
  std::error_code error;
  fs::path place = fs::absolute(folder, error);
  if (!error) place = fs::weakly_canonical(place, error);
  if (error) place = folder;
  return place.has_filename() ? place : place.parent_path();
}

/// OutputError where no file can be made.
void demand_ground(const fs::path& folder) {
  const fs::path ground = standing_ancestor(folder);
  std::error_code error;
  if (!fs::is_directory(ground, error))
    throw OutputError(ground.string() + " is not a folder", "choose another folder with -o");
  if (::access(ground.c_str(), W_OK | X_OK) != 0) fail_output("cannot write in", ground, errno);
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  return entries;
}

bool is_within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
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

/// May another folder take the place of this one, with nobody the worse?
bool is_replaceable(const fs::path& folder) {
  struct stat status {};
  struct stat above {};
  if (::lstat(folder.c_str(), &status) != 0 || ::lstat(folder.parent_path().c_str(), &above) != 0) return false;
  if (!S_ISDIR(status.st_mode) || status.st_dev != above.st_dev || status.st_uid != ::geteuid()) return false;
  std::error_code error;
  const fs::path here = fs::current_path(error);
  if (error || is_within(here, folder) || has_attributes(folder)) return false;
  const std::vector<fs::path> entries = entries_of(folder);
  return std::none_of(entries.begin(), entries.end(),
                      [](const fs::path& entry) { return fs::is_directory(fs::symlink_status(entry)); });
}

bool set_rights(const fs::path& folder, const fs::path& like) {
  struct stat status {};
  if (::lstat(like.c_str(), &status) != 0) return false;
  return ::chown(folder.c_str(), static_cast<uid_t>(-1), status.st_gid) == 0 &&
         ::chmod(folder.c_str(), status.st_mode & 07777) == 0;
}

void set_ordinary_rights(const fs::path& folder) {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::chmod(folder.c_str(), 0777 & ~mask);
}

bool rename_as(const fs::path& from, const fs::path& to, unsigned how) {
  return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), how) == 0;
}

/// The journal is a manifest of what is about to go.
std::string journal_of(const fs::path& folder, const std::vector<std::string>& replaced,
                       const std::vector<std::string>& withdrawn) {
  Json journal = {{"tool", "fusee"}, {"outputs", Json::array()}, {"withdrawn", withdrawn}};
  for (const auto* names : {&replaced, &withdrawn}) {
    for (const std::string& name : *names) {
      if (!stands(folder / name)) continue;
      journal["outputs"].push_back({{"file", name}, {"sha256", sha256(read_output(folder / name, k_largest_output))}});
    }
  }
  return json_text(journal, -1);
}

bool is_of(const Owned& owned, const fs::path& file) {
  return fs::is_regular_file(fs::symlink_status(file)) &&
         owned.count({file.filename().string(), sha256(read_output(file, k_largest_output))}) != 0;
}

/// Ends what a run began that was killed between two renames; nothing when somebody changed the files since.
void end_publishing(const fs::path& staging, const fs::path& folder) {
  Owned owned;
  if (!read_manifest(staging / k_journal, owned)) return;
  std::vector<fs::path> rest;
  for (const fs::path& file : entries_of(staging))
    if (file.filename().string().front() != '.' && file.filename() != k_manifest) rest.push_back(file);
  const auto may_go = [&](const fs::path& file) {
    const fs::path target = folder / file.filename();
    return !stands(target) || is_of(owned, target);
  };
  if (!std::all_of(rest.begin(), rest.end(), may_go)) return;
  for (const fs::path& file : rest)
    if (::rename(file.c_str(), (folder / file.filename()).c_str()) != 0) return;
  ::rename((staging / k_manifest).c_str(), (folder / k_manifest).c_str());
  const Json journal = parse_json(read_output(staging / k_journal, k_largest_manifest));
  for (const std::string& name : journal.at("withdrawn").get<std::vector<std::string>>())
    if (is_of(owned, folder / name)) ::unlink((folder / name).c_str());
}

void end_killed_publishing_in(const fs::path& place) {
  if (stale_stagings(place).empty()) return;
  const Turn turn(place.parent_path());
  for (const fs::path& staging : stale_stagings(place)) end_publishing(staging, place);
  remove_stale_stagings(place);
}

/// Some of its set were renamed already, and some wait in the staging folder.
bool is_half_published(const fs::path& staging, const fs::path& file) {
  if (!stands(staging / k_journal)) return false;
  Owned set;
  read_manifest(staging / k_manifest, set);
  std::set<std::string> names;
  for (const auto& [name, hash] : set) names.insert(name);
  for (const fs::path& entry : entries_of(staging)) {
    const std::string name = entry.filename().string();
    if (name.rfind(k_backup_prefix, 0) == 0) names.insert(name.substr(k_backup_prefix.size()));
    if (name.front() != '.') names.insert(name);
  }
  const auto waits = [&staging](const std::string& name) { return stands(staging / name); };
  const auto waiting = static_cast<std::size_t>(std::count_if(names.begin(), names.end(), waits));
  return waiting > 0 && waiting < names.size() && names.count(file.filename().string()) != 0;
}

}  // namespace

void end_killed_publishing(const fs::path& file) {
  const fs::path place = place_of(file.has_parent_path() ? file.parent_path() : fs::path("."));
  if (stale_stagings(place).empty()) return;
  end_killed_publishing_in(place);
  for (const fs::path& staging : stale_stagings(place)) {
    if (!is_half_published(staging, file)) continue;
    throw InputError(file.string(), "belongs to a set of files that a killed run of fusee left half old and half new",
                     "run it again there, as one who may write in " + place.string());
  }
}

OutputFolder::OutputFolder(fs::path folder, bool force)
    : folder_(folder.empty() ? "." : std::move(folder)),
      place_(place_of(folder_)),
      force_(force),
      missing_(std::make_unique<MissingFolders>()) {
  if (FileAccess* access = FileAccess::current()) access->will_write(folder_);
  end_killed_publishing_in(place_);
  earlier_run_ = read_manifest(place_ / k_manifest, ours_);
}

OutputFolder::~OutputFolder() = default;

void OutputFolder::claim(const std::vector<std::string>& names) {
  const Turn turn(place_.parent_path());
  if (read_manifest(place_ / k_manifest, ours_))
    earlier_run_ = true;  // another run may have published since this one began
  demand_ours(names);
}

void OutputFolder::demand_ours(const std::vector<std::string>& names) const {
  demand_ground(folder_);
  std::string foreign, changed;
  for (const std::string& name : names) {
    const fs::path target = folder_ / name;
    if (!stands(target)) continue;
    if (!fs::is_regular_file(fs::symlink_status(target))) {
      tell_in_the_way(target);
      throw OutputError(target.string() + " is in the way and is not a regular file",
                        "move it away, or choose another folder with -o");
    }
    if (force_ || (name == k_manifest && earlier_run_)) continue;
    const auto by_name = [&name](const auto& entry) { return entry.first == name; };
    if (std::none_of(ours_.begin(), ours_.end(), by_name)) {
      foreign += (foreign.empty() ? "" : ", ") + name;
      tell_in_the_way(target);
    } else if (ours_.count({name, sha256(read_output(target, k_largest_output))}) == 0) {
      changed += (changed.empty() ? "" : ", ") + name;
    }
  }
  if (foreign.empty() && changed.empty()) return;
  std::string message = folder_.string() + " holds ";
  if (!foreign.empty()) message += "files that fusee did not write: " + foreign;
  if (!changed.empty())
    message += (foreign.empty() ? "" : "; and ") + ("files that were changed after fusee wrote them: " + changed);
  throw OutputError(message, "choose another folder with -o, or overwrite them with --force");
}

void OutputFolder::discard() const {
  if (staging_) staging_->remove();
  missing_->remove();
}

/// Beside the folder where it can be replaced as a whole, so that what a killed run leaves does not lie in it either.
void OutputFolder::open_staging() {
  if (staging_) return;
  demand_ground(folder_);
  const fs::path above = place_.parent_path();
  if (!stands(place_) || is_replaceable(place_)) {
    missing_->make(above);
    if (::access(above.c_str(), W_OK | X_OK) == 0) {
      remove_stale_stagings(above);
      staging_ = std::make_unique<Staging>(above);
      return;
    }
  }
  missing_->make(place_);
  staging_ = std::make_unique<Staging>(place_);
}

void OutputFolder::stage(const OutputFile& file) {
  const bool plain = !file.name.empty() && file.name.front() != '.' && file.name.find('/') == std::string::npos;
  demand(plain, "output name " + file.name);
  open_staging();
  demand(std::find(staged_.begin(), staged_.end(), file.name) == staged_.end(), "staged twice: " + file.name);
  staged_.push_back(file.name);
  write_whole(staging_->path() / file.name, file.bytes);
}

fs::path OutputFolder::staged_path(const std::string& name) const { return staging_->path() / name; }

void OutputFolder::withdraw(const std::vector<std::string>& names) { withdrawn_ = names; }

/// Those that an earlier run wrote, that nobody changed since, and that this run did not write.
std::vector<std::string> OutputFolder::obsolete() const {
  std::vector<std::string> names;
  for (const std::string& name : withdrawn_) {
    const bool staged = std::find(staged_.begin(), staged_.end(), name) != staged_.end();
    if (!staged && is_of(ours_, place_ / name)) names.push_back(name);
  }
  return names;
}

/// One rename of the folder; false, with nothing changed, where that cannot be.
bool OutputFolder::publish_as_folder(const std::vector<std::string>& gone) {
  const fs::path& made = staging_->path();
  if (made.parent_path() != place_.parent_path()) return false;
  if (!stands(place_)) {
    set_ordinary_rights(made);
    flush_all({made});
    if (!rename_as(made, place_, RENAME_NOREPLACE) && ::rename(made.c_str(), place_.c_str()) != 0) return false;
    staging_->let_go();
    flush_all({place_.parent_path()});
    return true;
  }
  if (!is_replaceable(place_) || !set_rights(made, place_)) return false;
  const auto is_listed = [](const std::vector<std::string>& list, const fs::path& entry) {
    return std::find(list.begin(), list.end(), entry.filename().string()) != list.end();
  };
  std::vector<fs::path> kept;
  const auto undone = [&kept] {
    for (const fs::path& link : kept) ::unlink(link.c_str());
    return false;
  };
  for (const fs::path& entry : entries_of(place_)) {
    if (is_listed(staged_, entry) || is_listed(gone, entry)) continue;
    kept.push_back(made / entry.filename());
    if (::link(entry.c_str(), kept.back().c_str()) != 0) return undone();
  }
  flush_all({made});
  if (!rename_as(made, place_, RENAME_EXCHANGE)) return undone();
  flush_all({place_.parent_path()});
  // The old folder has the staging's name now. What came into it while its entries were listed is brought along.
  for (const fs::path& entry : entries_of(made)) {
    const bool known = is_listed(staged_, entry) || is_listed(gone, entry) || stands(place_ / entry.filename());
    if (known) {
      ::unlink(entry.c_str());
    } else {
      ::rename(entry.c_str(), (place_ / entry.filename()).c_str());
    }
  }
  ::rmdir(made.c_str());
  staging_->let_go();
  return true;
}

void OutputFolder::put_back(const std::vector<std::string>& published) const {
  for (const std::string& name : published) {
    const fs::path backup = staging_->path() / (std::string(k_backup_prefix) + name);
    if (::rename(backup.c_str(), (place_ / name).c_str()) != 0) ::unlink((place_ / name).c_str());
  }
}

/// One rename a file, the manifest last.
void OutputFolder::publish_one_by_one(const std::vector<std::string>& gone) {
  missing_->make(place_);
  if (staging_->path().parent_path() != place_ && !staging_->move_into(place_))
    fail_output("cannot write in", place_, errno);
  const fs::path& from = staging_->path();
  if (staged_.size() + gone.size() > 1) {
    write_whole(from / k_journal, journal_of(place_, staged_, gone));
    flush_all({from / k_journal, from});
  }
  std::vector<std::string> published;
  for (const std::string& name : staged_) {
    const fs::path target = place_ / name, backup = from / (std::string(k_backup_prefix) + name);
    // A second name for the earlier file, so that it can be put back. File systems without hard links go without.
    if (::link(target.c_str(), backup.c_str()) != 0) errno = 0;
    if (::rename((from / name).c_str(), target.c_str()) != 0) {
      const int code = errno;
      put_back(published);
      fail_output("cannot write", target, code);
    }
    published.push_back(name);
  }
  for (const std::string& name : gone) ::unlink((place_ / name).c_str());
  flush_all({place_});
}

void OutputFolder::publish() {
  if (!staging_) return;
  const Turn turn(place_.parent_path());
  if (read_manifest(place_ / k_manifest, ours_)) earlier_run_ = true;
  const auto not_manifest = [](const std::string& name) { return name != k_manifest; };
  std::stable_partition(staged_.begin(), staged_.end(), not_manifest);
  demand_ours(staged_);
  std::vector<fs::path> to_flush;
  for (const std::string& name : staged_) to_flush.push_back(staging_->path() / name);
  flush_all(to_flush);
  const std::vector<std::string> gone = obsolete();
  if (FileAccess* access = FileAccess::current()) {
    for (const std::string& name : staged_)
      access->wrote(folder_ / name, read_output(staging_->path() / name, k_largest_output));
  }
  if (!publish_as_folder(gone)) publish_one_by_one(gone);
  staging_.reset();
  staged_.clear();
}

void write_file(const fs::path& path, std::string_view bytes, bool force) {
  FileAccess* access = FileAccess::current();
  if (access != nullptr) access->will_write(path);
  std::error_code error;
  const fs::path target = fs::is_symlink(path) ? fs::weakly_canonical(path, error) : path;
  if (stands(target) && (!force || !fs::is_regular_file(fs::symlink_status(target)))) tell_in_the_way(path);
  if (stands(target) && !fs::is_regular_file(fs::symlink_status(target))) {
    throw OutputError(path.string() + " exists and is not a regular file", "choose another name");
  }
  if (stands(target) && !force)
    throw OutputError(path.string() + " exists", "choose another name, or overwrite it with --force");
  const fs::path name = target.filename();
  if (name.empty() || name == "." || name == "..")
    throw OutputError(path.string() + " names no file", "add a file name");
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  demand_ground(folder);
  MissingFolders missing;
  missing.make(folder);
  remove_stale_stagings(folder);
  const Staging staging(folder);
  const fs::path made = staging.path() / "file";
  write_whole(made, bytes);
  flush_all({made});
  if (::rename(made.c_str(), target.c_str()) != 0) fail_output("cannot write", target, errno);
  flush_all({folder});
  if (access != nullptr) access->wrote(path, bytes);
}

}  // namespace fusee
