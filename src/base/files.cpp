#include "fusee/base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <future>
#include <nlohmann/json.hpp>

#include "base/output_list.h"
#include "fusee/base/diagnostics.h"

namespace fusee {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_manifest = "manifest.json";
constexpr std::string_view k_staging_prefix = ".fusee-";
constexpr std::string_view k_backup_prefix = ".earlier-";
/// More than any output of ours; a file beyond it was not written by us.
constexpr std::size_t k_largest_output = std::size_t{4} << 30;
constexpr std::size_t k_largest_manifest = 16 << 20;

std::string error_text(int code) { return std::error_code(code, std::generic_category()).message(); }

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  bool ok() const { return number_ >= 0; }
  /// Closes now; false with errno when the bytes did not get there.
  bool close() {
    const int number = number_;
    number_ = -1;
    return ::close(number) == 0;
  }

 private:
  int number_;
};

[[noreturn]] void fail_output(const std::string& what, const fs::path& path, int code) {
  std::string hint;
  if (code == ENOSPC || code == EDQUOT) hint = "the disk is full: make room, or choose another folder with -o";
  if (code == EACCES || code == EPERM || code == EROFS) hint = "choose a folder that you may write to with -o";
  throw OutputError(what + " " + path.string() + ": " + error_text(code), hint);
}

/// True when `path` itself exists, whatever it is (a dangling link too).
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
  if (!file.close()) fail_output("cannot write", path, errno);
}

/// Flushes a file or folder to the disk.
void flush(const fs::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.ok()) fail_output("cannot write", path, errno);
  // Some file systems know no fsync of folders: that is no failure.
  if (::fsync(file.number()) != 0 && errno != EINVAL && errno != ENOTSUP) fail_output("cannot write", path, errno);
}

/// Flushes files together: the disk takes few turns for all of them where one after another would take one each.
void flush_all(const std::vector<fs::path>& paths) {
  std::vector<std::future<void>> flushes;
  for (const fs::path& path : paths)
    flushes.push_back(std::async(std::launch::async | std::launch::deferred, flush, path));
  for (std::future<void>& done : flushes) done.get();
}

using Owned = std::set<std::pair<std::string, std::string>>;

/// Adds what a manifest says fusee wrote. False when it is no manifest of fusee.
bool read_manifest(const fs::path& path, Owned& owned) {
  using Json = nlohmann::json;
  std::string text;
  try {
    text = read_file(path, k_largest_manifest);
  } catch (const InputError&) {
    return false;
  }
  // nlohmann parses nested lists without recursion, but destroys and compares them with it; a manifest nests three
  // deep.
  const auto shallow = [](int depth, Json::parse_event_t, Json&) { return depth <= 8; };
  const Json manifest = Json::parse(text, shallow, /*allow_exceptions=*/false);
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

/// A staging folder is named .fusee-<process>-XXXXXX; it is stale when that process is gone and nobody holds its lock
/// (a process of another container may carry a number that is not seen here).
bool is_stale(const fs::path& staging) {
  const std::string name = staging.filename().string();
  if (name.rfind(k_staging_prefix, 0) != 0) return false;
  pid_t process = 0;
  const char* begin = name.data() + k_staging_prefix.size();
  const auto [end, error] = std::from_chars(begin, name.data() + name.size(), process);
  if (error != std::errc() || *end != '-' || process <= 0) return false;
  if (::kill(process, 0) == 0 || errno != ESRCH) return false;
  const Descriptor folder(::open(staging.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  return folder.ok() && ::flock(folder.number(), LOCK_EX | LOCK_NB) == 0;
}

std::vector<fs::path> stale_stagings(const fs::path& folder) {
  std::vector<fs::path> stale;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (is_stale(it->path())) stale.push_back(it->path());
  }
  return stale;
}

/// The deepest part of `path` that exists.
fs::path standing_ancestor(fs::path path) {
  while (!stands(path) && path.has_parent_path() && path != path.parent_path()) path = path.parent_path();
  return stands(path) ? path : fs::path(".");
}

}  // namespace

// ---- reading --------------------------------------------------------------------------------------------------------

std::string read_file(const fs::path& path, std::size_t limit) {
  const std::string name = path.string();
  // O_NONBLOCK: a pipe that nobody writes to must not hang us.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!file.ok())
    throw InputError(name, "cannot be read: " + error_text(errno), errno == ENOENT ? "check the path" : "");
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) throw InputError(name, "cannot be read: " + error_text(errno));
  if (S_ISDIR(status.st_mode)) throw InputError(name, "is a directory", "name a file in it");
  if (!S_ISREG(status.st_mode)) throw InputError(name, "is not a regular file", "write it to a file first");
  const auto too_large = [&] {
    return InputError(name, fmt::format("is larger than {} bytes", limit), "is it the right file?");
  };
  if (static_cast<std::uintmax_t>(status.st_size) > limit) throw too_large();
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t filled = 0;
  // One byte more than stat promised, to see the end of the file; files of /proc promise none at all.
  for (;;) {
    if (filled == bytes.size())
      bytes.resize(std::min(bytes.size() + std::max<std::size_t>(bytes.size() / 2, 4096), limit + 1));
    const ssize_t count = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw InputError(name, "cannot be read: " + error_text(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
    if (filled > limit) throw too_large();
  }
  bytes.resize(filled);
  return bytes;
}

std::string sha256(std::string_view bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  demand(EVP_Digest(bytes.data(), bytes.size(), digest, &size, EVP_sha256(), nullptr) == 1, "SHA-256 is not to be had");
  std::string text;
  for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

nlohmann::ordered_json output_list(const std::vector<OutputFile>& files) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const OutputFile& file : files)
    list.push_back({{"file", file.name}, {"bytes", file.bytes.size()}, {"sha256", sha256(file.bytes)}});
  return list;
}

// ---- a folder of outputs --------------------------------------------------------------------------------------------

OutputFolder::OutputFolder(fs::path folder, bool force)
    : folder_(folder.empty() ? "." : std::move(folder)), force_(force) {
  earlier_run_ = read_manifest(folder_ / k_manifest, ours_);
  for (const fs::path& staging : stale_stagings(folder_)) read_manifest(staging / k_manifest, ours_);
}

OutputFolder::~OutputFolder() { close_staging(); }

void OutputFolder::claim(const std::vector<std::string>& names) const {
  const fs::path ground = standing_ancestor(folder_);
  std::error_code error;
  if (!fs::is_directory(ground, error)) {
    throw OutputError(ground.string() + " is not a folder", "choose another folder with -o");
  }
  if (::access(ground.c_str(), W_OK | X_OK) != 0) fail_output("cannot write in", ground, errno);
  std::string foreign, changed;
  for (const std::string& name : names) {
    const fs::path target = folder_ / name;
    if (!stands(target)) continue;
    if (!fs::is_regular_file(fs::symlink_status(target))) {
      throw OutputError(target.string() + " is in the way and is not a regular file",
                        "move it away, or choose another folder with -o");
    }
    if (force_ || (name == k_manifest && earlier_run_)) continue;
    const auto by_name = [&name](const auto& entry) { return entry.first == name; };
    if (std::none_of(ours_.begin(), ours_.end(), by_name)) {
      foreign += (foreign.empty() ? "" : ", ") + name;
    } else if (ours_.count({name, sha256(read_file(target, k_largest_output))}) == 0) {
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

void OutputFolder::open_staging() {
  if (!staging_.empty()) return;
  std::vector<fs::path> missing;
  for (fs::path path = folder_; !path.empty() && !stands(path); path = path.parent_path()) missing.push_back(path);
  for (auto path = missing.rbegin(); path != missing.rend(); ++path) {
    if (path->filename().empty()) continue;  // "out/" with its slash
    if (::mkdir(path->c_str(), 0777) == 0) {
      made_folders_.push_back(*path);
    } else if (errno != EEXIST) {
      fail_output("cannot make the folder", *path, errno);
    }
  }
  remove_stale();
  std::string pattern = (folder_ / fmt::format("{}{}-XXXXXX", k_staging_prefix, ::getpid())).string();
  if (::mkdtemp(pattern.data()) == nullptr) fail_output("cannot write in", folder_, errno);
  staging_ = pattern;
  lock_ = ::open(staging_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);
}

void OutputFolder::close_staging() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
  staging_.clear();
  staged_.clear();
  if (lock_ >= 0) ::close(lock_);
  lock_ = -1;
  // Folders made for this run and left empty go, the innermost first.
  for (auto path = made_folders_.rbegin(); path != made_folders_.rend(); ++path) ::rmdir(path->c_str());
  made_folders_.clear();
}

void OutputFolder::remove_stale() const {
  std::error_code ignored;
  for (const fs::path& staging : stale_stagings(folder_)) fs::remove_all(staging, ignored);
}

void OutputFolder::stage(const OutputFile& file) {
  const bool plain = !file.name.empty() && file.name.front() != '.' && file.name.find('/') == std::string::npos;
  demand(plain, "output name " + file.name);
  claim({file.name});
  open_staging();
  demand(std::find(staged_.begin(), staged_.end(), file.name) == staged_.end(), "staged twice: " + file.name);
  staged_.push_back(file.name);
  write_whole(staging_ / file.name, file.bytes);
}

fs::path OutputFolder::staged_path(const std::string& name) const { return staging_ / name; }

void OutputFolder::put_back(const std::vector<std::string>& published) const {
  for (const std::string& name : published) {
    const fs::path backup = staging_ / (std::string(k_backup_prefix) + name);
    if (::rename(backup.c_str(), (folder_ / name).c_str()) != 0) ::unlink((folder_ / name).c_str());
  }
}

void OutputFolder::publish() {
  if (staging_.empty()) return;
  const auto not_manifest = [](const std::string& name) { return name != k_manifest; };
  std::stable_partition(staged_.begin(), staged_.end(), not_manifest);
  claim(staged_);
  std::vector<fs::path> to_flush{staging_};
  for (const std::string& name : staged_) to_flush.push_back(staging_ / name);
  flush_all(to_flush);
  std::vector<std::string> published;
  for (const std::string& name : staged_) {
    const fs::path target = folder_ / name, backup = staging_ / (std::string(k_backup_prefix) + name);
    // A second name for the earlier file, so that it can be put back. File systems without hard links go without.
    if (::link(target.c_str(), backup.c_str()) != 0) errno = 0;
    if (::rename((staging_ / name).c_str(), target.c_str()) != 0) {
      const int code = errno;
      put_back(published);
      fail_output("cannot write", target, code);
    }
    published.push_back(name);
  }
  published_ = published;
  made_folders_.clear();
  flush(folder_);
  close_staging();
}

void OutputFolder::withdraw(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    const fs::path path = folder_ / name;
    const bool published = std::find(published_.begin(), published_.end(), name) != published_.end();
    if (published || !fs::is_regular_file(fs::symlink_status(path))) continue;
    if (ours_.count({name, sha256(read_file(path, k_largest_output))}) != 0) ::unlink(path.c_str());
  }
}

void write_file(const fs::path& path, std::string_view bytes, bool force) {
  std::error_code error;
  const fs::path target = fs::is_symlink(path) ? fs::weakly_canonical(path, error) : path;
  if (stands(target) && !fs::is_regular_file(fs::symlink_status(target))) {
    throw OutputError(path.string() + " exists and is not a regular file", "choose another name");
  }
  if (stands(target) && !force)
    throw OutputError(path.string() + " exists", "choose another name, or overwrite it with --force");
  const std::string name = target.filename().string();
  if (name.empty()) throw OutputError(path.string() + " names no file", "add a file name");
  OutputFolder folder(target.parent_path(), /*force=*/true);
  folder.stage({name, std::string(bytes)});
  folder.publish();
}

}  // namespace fusee
