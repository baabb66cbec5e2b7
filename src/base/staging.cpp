#include "base/staging.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <future>
#include <thread>

#include "base/descriptor.h"
#include "fusee/base/diagnostics.h"

namespace fusee {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view k_prefix = ".fusee-";

void flush(const fs::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.ok()) fail_output("cannot write", path, errno);
  // Some file systems know no fsync of folders: that is no failure.
  if (::fsync(file.number()) != 0 && errno != EINVAL && errno != ENOTSUP) fail_output("cannot write", path, errno);
}

/// Stale when its process is gone and nobody holds its lock (a process of another container may carry a number that is
/// not seen here).
bool is_stale(const fs::path& staging) {
  const std::string name = staging.filename().string();
  if (name.rfind(k_prefix, 0) != 0) return false;
  pid_t process = 0;
  const char* begin = name.data() + k_prefix.size();
  const auto [end, error] = std::from_chars(begin, name.data() + name.size(), process);
  if (error != std::errc() || *end != '-' || process <= 0) return false;
  if (::kill(process, 0) == 0 || errno != ESRCH) return false;
  const Descriptor folder(::open(staging.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  return folder.ok() && ::flock(folder.number(), LOCK_EX | LOCK_NB) == 0;
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
  // It is on its way to the disk while the next ones are made: flush_all() has less to wait for. No matter where this
  // cannot be.
  ::sync_file_range(file.number(), 0, 0, SYNC_FILE_RANGE_WRITE);
  if (!file.close()) fail_output("cannot write", path, errno);
}

void flush_all(const std::vector<fs::path>& paths) {
  std::vector<std::future<void>> flushes;
  for (const fs::path& path : paths)
    flushes.push_back(std::async(std::launch::async | std::launch::deferred, flush, path));
  for (std::future<void>& done : flushes) done.get();
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

Staging::Staging(const fs::path& within) {
  std::string pattern = (within / fmt::format("{}{}-XXXXXX", k_prefix, ::getpid())).string();
  if (::mkdtemp(pattern.data()) == nullptr) fail_output("cannot write in", within, errno);
  path_ = pattern;
  lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);
}

Staging::~Staging() {
  remove();
  if (lock_ >= 0) ::close(lock_);
}

void Staging::remove() const {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

bool Staging::move_into(const fs::path& folder) {
  const fs::path there = folder / path_.filename();
  if (::rename(path_.c_str(), there.c_str()) != 0) return false;
  path_ = there;
  return true;
}

std::vector<fs::path> stale_stagings(const fs::path& folder) {
  std::vector<fs::path> stale;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (is_stale(it->path())) stale.push_back(it->path());
  }
  return stale;
}

void remove_stale_stagings(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& staging : stale_stagings(folder)) fs::remove_all(staging, ignored);
}

// ---- one at a time --------------------------------------------------------------------------------------------------

Turn::Turn(const fs::path& folder) : lock_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  using namespace std::chrono_literals;
  // Publishing takes milliseconds: who holds it for a minute was stopped.
  constexpr int k_looks = 6000;
  for (int look = 0; lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0; ++look) {
    if (errno != EWOULDBLOCK && errno != EINTR) return;  // some file systems know no locks
    if (look == k_looks) {
      ::close(lock_);
      throw OutputError("another run of fusee is publishing in " + folder.string() + " and does not come to an end",
                        "end it, or choose another folder with -o");
    }
    std::this_thread::sleep_for(10ms);
  }
}

Turn::~Turn() {
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace fusee
