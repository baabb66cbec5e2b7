#include "base/staging.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "base/descriptor.h"
#include "fusee/base/diagnostics.h"
#include "fusee/base/files.h"

namespace fusee {
namespace {

namespace fs = std::filesystem;

void flush(const fs::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.ok()) fail_output("cannot write", path, errno);
  // Some file systems know no fsync of folders: that is no failure.
  if (::fsync(file.number()) != 0 && errno != EINVAL && errno != ENOTSUP) fail_output("cannot write", path, errno);
}

bool exchange(const fs::path& one, const fs::path& other) {
  return ::renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
}

}  // namespace

void fail_output(const std::string& what, const fs::path& path, int code) {
  std::string hint;
  if (code == ENOSPC || code == EDQUOT) hint = "the disk is full: make room, or choose another folder with -o";
  if (code == EFBIG) hint = "files may not be that large here: ulimit -f, or the file system's own limit";
  if (code == EACCES || code == EPERM || code == EROFS) hint = "choose a folder that you may write to with -o";
  throw OutputError(what + " " + path.string() + ": " + std::error_code(code, std::generic_category()).message(), hint);
}

bool stands(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

void write_whole(const fs::path& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.ok()) fail_output("cannot write", path, errno);
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_output("cannot write", path, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  // Starts the transfer to the disk while the next files are made: flush_all() waits less. A failure does not matter.
  ::sync_file_range(file.number(), 0, 0, SYNC_FILE_RANGE_WRITE);
  if (!file.close()) fail_output("cannot write", path, errno);
}

void flush_all(const std::vector<fs::path>& paths) {
  std::vector<std::future<void>> flushes;
  for (const fs::path& path : paths)
    flushes.push_back(std::async(std::launch::async | std::launch::deferred, flush, path));
  for (std::future<void>& done : flushes) done.get();
}

std::vector<std::string> names_in(const fs::path& folder) {
  const int number = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  const std::unique_ptr<DIR, int (*)(DIR*)> open(number < 0 ? nullptr : ::fdopendir(number), &::closedir);
  std::vector<std::string> names;
  if (open == nullptr) return names;
  while (const dirent* entry = ::readdir(open.get())) {
    const std::string name = entry->d_name;
    if (name != "." && name != "..") names.push_back(name);
  }
  return names;
}

bool move_if_free(const FolderEntry& from, const FolderEntry& to) {
  if (::renameat2(from.folder, from.name.c_str(), to.folder, to.name.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) return false;
  struct stat ignored {};
  if (::fstatat(to.folder, to.name.c_str(), &ignored, AT_SYMLINK_NOFOLLOW) == 0) {
    errno = EEXIST;
    return false;
  }
  return ::renameat(from.folder, from.name.c_str(), to.folder, to.name.c_str()) == 0;
}

// ---- folders --------------------------------------------------------------------------------------------------------

void MissingFolders::make(const fs::path& folder) {
  std::vector<fs::path> missing;
  for (fs::path path = folder; !path.empty() && !stands(path); path = path.parent_path()) missing.push_back(path);
  for (auto path = missing.rbegin(); path != missing.rend(); ++path) {
    if (path->filename().empty()) continue;  // "out/" with its slash
    if (::mkdir(path->c_str(), 0777) == 0) {
      made_.push_back(*path);
    } else if (errno != EEXIST) {
      fail_output("cannot make the folder", *path, errno);
    }
  }
}

MissingFolders::~MissingFolders() { remove(); }

void MissingFolders::remove() const {
  for (auto path = made_.rbegin(); path != made_.rend(); ++path) ::rmdir(path->c_str());
}

// ---- staging --------------------------------------------------------------------------------------------------------

std::string staging_key(const fs::path& place, StagingSite site) {
  return sha256(site == StagingSite::inside ? "." : place.filename().string()).substr(0, 8);
}

fs::path staging_ground(const fs::path& place, StagingSite site) {
  if (site == StagingSite::inside) return place;
  return place.has_parent_path() ? place.parent_path() : fs::path(".");
}

Staging::Staging(const fs::path& place, StagingSite site) : site_(site) {
  const fs::path ground = staging_ground(place, site);
  const std::string name = fmt::format(".fusee-{}-{}-XXXXXX", ::getpid(), staging_key(place, site));
  std::string pattern = (ground / name).string();
  if (::mkdtemp(pattern.data()) == nullptr) fail_output("cannot write in", ground, errno);
  root_ = pattern;
  path_ = root_ / "new";
  lock_ = ::open(root_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);
  // With the rights of an ordinary folder: it may become one.
  if (::mkdir(path_.c_str(), 0777) != 0) fail_output("cannot write in", root_, errno);
}

Staging::~Staging() {
  remove();
  if (lock_ >= 0) ::close(lock_);
}

void Staging::remove() const {
  if (stands(old())) return;  // the next run needs both
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  fs::remove_all(root_ / "obsolete", ignored);
  ::rmdir(root_.c_str());
}

void Staging::remove_old() const {
  std::error_code ignored;
  // By one rename first: a kill must not leave a part of the earlier files as if they were all.
  if (::rename(old().c_str(), (root_ / "obsolete").c_str()) == 0) fs::remove_all(root_ / "obsolete", ignored);
}

bool Staging::take_place_of(const fs::path& place, bool by_exchange) {
  if (by_exchange && exchange(path_, place)) {
    if (::rename(path_.c_str(), old().c_str()) == 0) return true;
    exchange(path_, place);
    return false;
  }
  if (::rename(place.c_str(), old().c_str()) != 0) return false;
  if (::rename(path_.c_str(), place.c_str()) == 0) return true;
  ::rename(old().c_str(), place.c_str());
  return false;
}

bool Staging::move_inside(const fs::path& place) {
  std::string name = root_.filename().string();
  const std::string from = staging_key(place, StagingSite::beside), to = staging_key(place, StagingSite::inside);
  name.replace(name.find(from), from.size(), to);
  if (!move_if_free({AT_FDCWD, root_}, {AT_FDCWD, place / name})) return false;
  site_ = StagingSite::inside;
  root_ = place / name;
  path_ = root_ / "new";
  return true;
}

bool Staging::mark_ready() {
  const fs::path ready = root_ / "ready";
  if (::rename(path_.c_str(), ready.c_str()) != 0) return false;
  path_ = ready;
  return true;
}

// ---- one at a time --------------------------------------------------------------------------------------------------

ReplacementLock::ReplacementLock(const fs::path& folder) : path_(folder / ".fusee-lock") {
  using namespace std::chrono_literals;
  const auto give_up = std::chrono::steady_clock::now() + 1min;
  for (;; std::this_thread::sleep_for(10ms)) {
    const int file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
    struct stat opened {};
    struct stat named {};
    const bool is_ours =
        file >= 0 && ::fstat(file, &opened) == 0 && opened.st_uid == ::geteuid() && (opened.st_mode & 077) == 0;
    const bool locked = is_ours && ::flock(file, LOCK_EX | LOCK_NB) == 0;
    const bool is_held = is_ours && !locked && (errno == EWOULDBLOCK || errno == EINTR);
    // The run that held it removed the file: this one may have no name any more.
    if (locked && ::lstat(path_.c_str(), &named) == 0 && named.st_ino == opened.st_ino) {
      file_ = file;
      return;
    }
    if (file >= 0) ::close(file);
    if (!locked && !is_held) return;
    if (std::chrono::steady_clock::now() > give_up)
      throw OutputError("another run of fusee has been writing in " + folder.string() + " for a minute",
                        "end it, or choose another folder with -o");
  }
}

ReplacementLock::~ReplacementLock() {
  if (file_ < 0) return;
  ::unlink(path_.c_str());
  ::close(file_);
}

}  // namespace fusee
