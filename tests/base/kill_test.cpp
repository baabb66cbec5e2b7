// A run that publishes is killed before each of its calls that change a file system, one after another. This program's
// own rename(), link() … stand in front of the system's, count, and kill.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdarg>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fusee/base/diagnostics.h"
#include "fusee/base/files.h"

namespace {

/// Calls until the end; 0: no end.
int calls_left = 0;
/// As on a disk that may only be read.
bool writable = true;

void before_a_change() {
  if (calls_left > 0 && --calls_left == 0) ::kill(::getpid(), SIGKILL);
}

template <class... Words>
int changed(long number, Words... words) {
  before_a_change();
  if (!writable) {
    errno = EROFS;
    return -1;
  }
  return static_cast<int>(::syscall(number, words...));
}

}  // namespace

extern "C" {
int rename(const char* from, const char* to) noexcept {
  return changed(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0U);
}
int renameat2(int a, const char* from, int b, const char* to, unsigned how) noexcept {
  return changed(SYS_renameat2, a, from, b, to, how);
}
int link(const char* from, const char* to) noexcept { return changed(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0); }
int unlink(const char* path) noexcept { return changed(SYS_unlinkat, AT_FDCWD, path, 0); }
int unlinkat(int folder, const char* path, int flags) noexcept { return changed(SYS_unlinkat, folder, path, flags); }
int rmdir(const char* path) noexcept { return changed(SYS_unlinkat, AT_FDCWD, path, AT_REMOVEDIR); }
int mkdir(const char* path, mode_t mode) noexcept { return changed(SYS_mkdirat, AT_FDCWD, path, mode); }
int chmod(const char* path, mode_t mode) noexcept { return changed(SYS_fchmodat, AT_FDCWD, path, mode); }
int fsync(int) { return 0; }  // a kill loses nothing that was written; waiting for the disk is most of the time
ssize_t write(int file, const void* bytes, size_t count) {
  before_a_change();
  return ::syscall(SYS_write, file, bytes, count);
}
}

namespace fusee {
namespace {

namespace fs = std::filesystem;

using Folder = std::map<std::string, std::string>;

/// Everything but what a killed run staged.
Folder files_in(const fs::path& folder) {
  Folder files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(".fusee-", 0) == 0) continue;
    std::ostringstream text;
    text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    files[name] = text.str();
  }
  return files;
}

Folder set_of(const std::string& text, const std::vector<std::string>& names) {
  Folder files;
  nlohmann::json manifest = {{"schema", 1}, {"tool", "fusee 0.1.0"}, {"outputs", nlohmann::json::array()}};
  for (const std::string& name : names) {
    files[name] = text + name;
    manifest["outputs"].push_back({{"file", name}, {"sha256", sha256(files[name])}});
  }
  files["manifest.json"] = manifest.dump();
  return files;
}

void publish(const fs::path& folder, const Folder& files) {
  OutputFolder output(folder, false);
  for (const auto& [name, bytes] : files) output.stage({name, bytes});
  output.withdraw({"profile.csv", "pulley_p1.stl"});
  output.publish();
}

/// True when it was killed.
template <class Action>
bool killed_before(int call, Action action) {
  const pid_t child = ::fork();
  if (child == 0) {
    calls_left = call;
    action();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
  return WIFSIGNALED(status);
}

/// What stands in a folder before a run publishes in it.
struct Ground {
  const char* name;
  bool earlier_run;  ///< of fusee
  bool notes;        ///< a file of somebody else's
  bool subfolder;    ///< no other folder may take its place
};

class Kill : public testing::TestWithParam<Ground> {
 protected:
  void SetUp() override {
    std::string pattern = (fs::path(testing::TempDir()) / "fusee_kill_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    root_ = pattern;
  }
  void TearDown() override { fs::remove_all(root_); }

  /// The folder as it is before the run.
  fs::path prepared(int call) const {
    const Ground& ground = GetParam();
    const fs::path folder = root_ / std::to_string(call) / "out";
    fs::create_directories(folder.parent_path());
    if (ground.earlier_run) publish(folder, older_);
    if (ground.notes) std::ofstream(folder / "notes.txt") << "mine";
    if (ground.subfolder) fs::create_directory(folder / "mine");
    return folder;
  }
  Folder with_the_rest(Folder files) const {
    if (GetParam().notes) files["notes.txt"] = "mine";
    if (GetParam().subfolder) files["mine"] = "";
    return files;
  }

  const Folder older_ = set_of("old ", {"pulley.stl", "pulley_p1.stl", "report.html"});
  const Folder newer_ = set_of("new ", {"profile.csv", "pulley.stl", "report.html"});
  fs::path root_;
};

TEST_P(Kill, LeavesTheOldSetOrTheNewOne) {
  const Folder before = with_the_rest(GetParam().earlier_run ? older_ : Folder{}), after = with_the_rest(newer_);
  int old_sets = 0, new_sets = 0, call = 1;
  for (bool killed = true; killed; ++call) {
    const fs::path folder = prepared(call);
    ASSERT_EQ(files_in(folder), before);
    killed = killed_before(call, [&] { publish(folder, newer_); });
    if (GetParam().subfolder) OutputFolder(folder, false);  // the next start, which is here a run that does nothing
    const Folder left = files_in(folder);
    ASSERT_TRUE(left == before || left == after)
        << "killed before call " << call << ": " << testing::PrintToString(left);
    ++(left == after ? new_sets : old_sets);
    ASSERT_TRUE(killed || left == after);
    publish(folder, older_);  // the next run finds its way, and cleans up
    EXPECT_EQ(files_in(folder), with_the_rest(older_));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.parent_path()), {}), 1);
    EXPECT_EQ(static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {})),
              with_the_rest(older_).size());
  }
  EXPECT_GT(old_sets, 4);
  EXPECT_GT(new_sets, 0);
}

/// "old " or "new "; "" where the reader was told that it is some of both.
std::string set_read_from(const fs::path& folder) {
  try {
    const std::string first = read_file(folder / "pulley.stl", 100), last = read_file(folder / "report.html", 100);
    EXPECT_EQ(first.substr(0, 4), last.substr(0, 4));
    return first.substr(0, 4);
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("left half old and half new"));
    return "";
  }
}

TEST_P(Kill, IsEndedByWhoReadsNext) {
  if (!GetParam().earlier_run) return;
  int halves = 0, call = 1;
  for (bool killed = true; killed; ++call) {
    const fs::path folder = prepared(call);
    killed = killed_before(call, [&] { publish(folder, newer_); });
    writable = false;
    halves += set_read_from(folder).empty() ? 1 : 0;
    writable = true;
    EXPECT_NE(set_read_from(folder), "");
    const Folder left = files_in(folder);
    EXPECT_TRUE(left == with_the_rest(older_) || left == with_the_rest(newer_)) << "killed before call " << call;
  }
  EXPECT_EQ(halves > 0, GetParam().subfolder);
}

INSTANTIATE_TEST_SUITE_P(Grounds, Kill,
                         testing::Values(Ground{"Nothing", false, false, false},
                                         Ground{"AnEarlierRun", true, false, false},
                                         Ground{"AnEarlierRunAndNotes", true, true, false},
                                         Ground{"AnEarlierRunAndAFolder", true, true, true}),
                         [](const auto& ground) { return std::string(ground.param.name); });

}  // namespace
}  // namespace fusee
