#include "base/staging.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <thread>

#include "base/thread_pool.h"
#include "fusee/base.h"

namespace fusee {
namespace fs = std::filesystem;

void fail_output(const std::string& failure, const fs::path& path, int errno_code) {
  std::string hint;
  if (errno_code == ENOSPC || errno_code == EDQUOT)
    hint = "the disk is full: free some space, or choose another folder with -o";
  if (errno_code == EFBIG) hint = "the file exceeds a size limit: ulimit -f, or that of the file system";
  if (errno_code == EACCES || errno_code == EPERM || errno_code == EROFS)
    hint = "choose a folder that you may write to with -o";
  throw OutputError(
      failure + " " + path.string() + ": " + std::error_code(errno_code, std::generic_category()).message(), hint);
}

bool entry_exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

fs::path place_of(const fs::path& folder) {
  std::error_code error;
  fs::path place = fs::absolute(folder, error);
  if (!error) place = fs::weakly_canonical(place, error);
  if (error) place = folder;
  return place.has_filename() ? place : place.parent_path();
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
  // Starts the transfer to the disk while the next files are made, which shortens flush_all(). Failure is harmless.
  ::sync_file_range(file.number(), 0, 0, SYNC_FILE_RANGE_WRITE);
  if (!file.close()) fail_output("cannot write", path, errno);
}

void flush_all(const std::vector<fs::path>& paths) {
  const auto flush = [](const fs::path& path) {
    const ThreadPool::WaitingScope for_disk(ThreadPool::shared());
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    // Some file systems do not support fsync of folders, which is no failure.
    if (!file.ok() || (::fsync(file.number()) != 0 && errno != EINVAL && errno != ENOTSUP))
      fail_output("cannot write", path, errno);
  };
  std::vector<Task<void>> flushes;
  for (const fs::path& path : paths) flushes.push_back(run_async([&flush, &path] { flush(path); }));
  for (Task<void>& flushed : flushes) flushed.get();
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator(); entry.increment(error))
    names.push_back(entry->path().filename().string());
  return names;
}

bool move_if_free(const fs::path& from, const fs::path& to, int from_folder, int to_folder) {
  if (::renameat2(from_folder, from.c_str(), to_folder, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) return false;
  // The file system lacks RENAME_NOREPLACE. Another process may make the entry between this test and the rename.
  struct stat ignored {};
  if (::fstatat(to_folder, to.c_str(), &ignored, AT_SYMLINK_NOFOLLOW) == 0) {
    errno = EEXIST;
    return false;
  }
  return ::renameat(from_folder, from.c_str(), to_folder, to.c_str()) == 0;
}

// ---- staging --------------------------------------------------------------------------------------------------------

std::string staging_key(const fs::path& place, StagingSite site) {
  return sha256(site == StagingSite::inside ? "." : place.filename().string()).substr(0, 8);
}

fs::path staging_parent(const fs::path& place, StagingSite site) {
  if (site == StagingSite::inside) return place;
  return place.has_parent_path() ? place.parent_path() : fs::path(".");
}

Staging::Staging(const fs::path& place, StagingSite site) : Staging(site) {
  const fs::path parent = staging_parent(place, site);
  root_ = parent / fmt::format(".fusee-{}-{}-XXXXXX", ::getpid(), staging_key(place, site));
  for (fs::path path = parent; !path.empty() && !entry_exists(path); path = path.parent_path()) made_.push_back(path);
  std::error_code error;
  fs::create_directories(parent, error);
  if (error) fail_output("cannot make the folder", parent, error.value());
  std::string pattern = root_.string();
  if (::mkdtemp(pattern.data()) == nullptr) fail_output("cannot write in", parent, errno);
  root_ = pattern;
  path_ = root_ / "new";
  lock_ = Descriptor(::open(root_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  ::flock(lock_.number(), LOCK_EX | LOCK_NB);
  // Mode of an ordinary folder, because it may become the output folder.
  if (::mkdir(path_.c_str(), 0777) != 0) fail_output("cannot write in", root_, errno);
}

void Staging::remove() const {
  if (entry_exists(old())) return;  // the next run needs old/ and new/
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  fs::remove_all(root_ / "obsolete", ignored);
  ::rmdir(root_.c_str());
  for (const fs::path& path : made_) ::rmdir(path.c_str());
}

void Staging::remove_old() const {
  std::error_code ignored;
  // One rename first: after a kill, partly removed earlier files must not look complete.
  if (::rename(old().c_str(), (root_ / "obsolete").c_str()) == 0) fs::remove_all(root_ / "obsolete", ignored);
}

bool Staging::take_place_of(const fs::path& place, bool by_exchange) {
  const auto renamed = [](const fs::path& from, const fs::path& to, unsigned flags) {
    return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0;
  };
  if (by_exchange && renamed(path_, place, RENAME_EXCHANGE)) {
    // path_ now holds the earlier folder.
    if (renamed(path_, old(), 0)) return true;
    renamed(path_, place, RENAME_EXCHANGE);  // undoes the exchange
    return false;
  }
  if (!renamed(place, old(), 0)) return false;
  if (renamed(path_, place, 0)) return true;
  renamed(old(), place, 0);  // undoes the first rename
  return false;
}

bool Staging::mark_ready() {
  const fs::path ready = root_ / "ready";
  if (::rename(path_.c_str(), ready.c_str()) != 0) return false;
  path_ = ready;
  return true;
}

// ---- lock for one-by-one replacement --------------------------------------------------------------------------------

ReplacementLock::ReplacementLock(const fs::path& folder) : path_(folder / ".fusee-lock") {
  using namespace std::chrono_literals;
  for (const auto begin = std::chrono::steady_clock::now(); std::chrono::steady_clock::now() - begin < 1min;
       std::this_thread::sleep_for(10ms)) {
    Descriptor file(::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600));
    struct stat opened {};
    struct stat named {};
    if (!file.ok() || ::fstat(file.number(), &opened) != 0) return;
    if (opened.st_uid != ::geteuid() || (opened.st_mode & 077) != 0) return;
    const bool locked = ::flock(file.number(), LOCK_EX | LOCK_NB) == 0;
    if (!locked && errno != EWOULDBLOCK) return;
    // The previous holder removes the file, so the locked file may no longer be the named one.
    if (!locked || ::lstat(path_.c_str(), &named) != 0 || named.st_ino != opened.st_ino) continue;
    file_ = std::move(file);
    return;
  }
  throw OutputError("another run of fusee has been writing in " + folder.string() + " for a minute",
                    "end it, or choose another folder with -o");
}

ReplacementLock::~ReplacementLock() {
  if (file_.ok()) ::unlink(path_.c_str());
}

}  // namespace fusee
