// Kills a publishing run before each of its file system calls, one after another. This program replaces rename(),
// link() and others by its own versions, which count and kill.

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

#include "fusee/base.h"

namespace {

/// Calls left until the one that is prevented; 0: no call is prevented.
int calls_left = 0;
/// The prevented call kills the run (true) or fails (false).
bool kills = true;
/// False simulates a file system without renameat2 exchange.
bool has_exchange = true;

/// Returns false when the call must fail.
bool may_change() {
  if (calls_left == 0 || --calls_left > 0) return true;
  if (kills) ::kill(::getpid(), SIGKILL);
  errno = EIO;
  return false;
}

/// The system call, unless may_change() prevents it.
template <class... Arguments>
int counted_call(long number, Arguments... arguments) {
  return may_change() ? static_cast<int>(::syscall(number, arguments...)) : -1;
}

}  // namespace

extern "C" {
int rename(const char* from, const char* to) noexcept {
  return counted_call(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0U);
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  return counted_call(SYS_renameat2, from_folder, from, to_folder, to, 0U);
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  if (has_exchange || flags == 0) return counted_call(SYS_renameat2, from_folder, from, to_folder, to, flags);
  errno = EINVAL;
  return -1;
}
int link(const char* from, const char* to) noexcept {
  return counted_call(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0);
}
int unlink(const char* path) noexcept { return counted_call(SYS_unlinkat, AT_FDCWD, path, 0); }
int unlinkat(int folder, const char* path, int flags) noexcept {
  return counted_call(SYS_unlinkat, folder, path, flags);
}
int rmdir(const char* path) noexcept { return counted_call(SYS_unlinkat, AT_FDCWD, path, AT_REMOVEDIR); }
int mkdir(const char* path, mode_t mode) noexcept { return counted_call(SYS_mkdirat, AT_FDCWD, path, mode); }
int chmod(const char* path, mode_t mode) noexcept { return counted_call(SYS_fchmodat, AT_FDCWD, path, mode); }
int fsync(int) { return 0; }  // a kill loses no written bytes, and fsync would dominate the run time
ssize_t write(int file, const void* bytes, size_t count) {
  return may_change() ? ::syscall(SYS_write, file, bytes, count) : -1;
}
}

namespace fusee {
namespace {

namespace fs = std::filesystem;

using Folder = std::map<std::string, std::string>;

/// All files except those staged by a killed run.
Folder files_in(const fs::path& folder) {
  Folder files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (name.rfind(".fusee-", 0) == 0 || name == "next") continue;
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

std::vector<Diagnostic> publish_set(const fs::path& folder, const Folder& files,
                                    const std::vector<std::string>& withdrawn = {"profile.csv", "pulley_p1.stl",
                                                                                 "next/run_1.csv"}) {
  OutputFolder output(folder, false);
  for (const auto& [name, bytes] : files) output.stage({name, bytes});
  output.withdraw(withdrawn);
  std::vector<Diagnostic> notes;
  output.publish(notes);
  return notes;
}

/// True when the run was killed.
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

/// Contents of a folder before a run publishes into it.
struct Ground {
  const char* name;
  bool earlier_run;  ///< fusee has published here before
  bool others;       ///< the folder holds a foreign file and a foreign folder
  bool exchange;     ///< the file system can exchange folders
  bool is_current;   ///< it is the run's current folder, which cannot be replaced
};

class Kill : public testing::TestWithParam<Ground> {
 protected:
  void SetUp() override {
    std::string pattern = (fs::path(testing::TempDir()) / "fusee_kill_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    root_ = pattern;
    has_exchange = GetParam().exchange;
  }
  void TearDown() override {
    has_exchange = true;
    fs::remove_all(root_);
  }

  /// The folder before the run.
  fs::path prepared(int call) const {
    const Ground& ground = GetParam();
    fs::path folder = root_ / std::to_string(call) / "out";
    fs::create_directories(ground.is_current ? folder : folder.parent_path());
    if (ground.earlier_run) publish_set(folder, older_);
    if (ground.others) {
      std::ofstream(folder / "notes.txt") << "mine";
      fs::create_directory(folder / "mine");
      std::ofstream(folder / "mine" / "notes.txt") << "mine too";
      fs::create_directory(folder / "next");
      std::ofstream(folder / "next" / "filled.csv") << "mine";
      fs::create_directory(folder / "next" / "mine");
      std::ofstream(folder / "next" / "mine" / "notes.txt") << "mine as well";
    }
    return folder;
  }
  void run_in(const fs::path& folder) const {
    if (GetParam().is_current) fs::current_path(folder);
    publish_set(folder, newer_);
  }
  Folder with_others(Folder files) const {
    if (GetParam().others) files.insert(others_.begin(), others_.end());
    return files;
  }
  /// Without files that are not fusee outputs.
  Folder without_others(Folder files) const {
    for (const auto& [name, bytes] : others_) files.erase(name);
    return files;
  }

  const Folder older_ =
      set_of("old ", {"next/page.html", "next/run_1.csv", "pulley.stl", "pulley_p1.stl", "report.html"});
  const Folder newer_ =
      set_of("new ", {"next/page.html", "next/run_2.csv", "profile.csv", "pulley.stl", "report.html"});
  const Folder others_ = {{"notes.txt", "mine"},       {"mine", ""},      {"mine/notes.txt", "mine too"},
                          {"next/filled.csv", "mine"}, {"next/mine", ""}, {"next/mine/notes.txt", "mine as well"}};
  fs::path root_;
};

TEST_P(Kill, LeavesOldOrNewSet) {
  const Folder before = GetParam().earlier_run ? older_ : Folder{};
  int old_sets = 0, new_sets = 0, put_back = 0, call = 1;
  for (bool killed = true; killed; ++call) {
    const fs::path folder = prepared(call);
    ASSERT_EQ(files_in(folder), with_others(before));
    killed = killed_before(call, [&] { run_in(folder); });
    const Folder left = without_others(files_in(folder));
    // Between two renames there is no set and no manifest.
    ASSERT_TRUE(left == before || left == newer_ || left.count("manifest.json") == 0)
        << "killed before call " << call << ": " << testing::PrintToString(left);
    ASSERT_TRUE(killed || left == newer_);
    // The next run, which writes a file of another name, restores the files set aside.
    const std::vector<Diagnostic> notes = publish_set(folder, {{"other.csv", "next"}}, {});
    Folder next = files_in(folder);
    EXPECT_EQ(next.erase("other.csv"), 1u);
    ASSERT_TRUE(next == with_others(before) || next == with_others(newer_))
        << "killed before call " << call << ": " << testing::PrintToString(next);
    ++(next == with_others(newer_) ? new_sets : old_sets);
    if (left != without_others(next)) {
      ++put_back;
      ASSERT_FALSE(notes.empty());
      EXPECT_THAT(notes.front().message, testing::HasSubstr("had set aside was put back"));
    }
    for (const fs::path& place : {folder, folder.parent_path()})
      for (const auto& entry : fs::directory_iterator(place))
        EXPECT_THAT(entry.path().filename().string(), testing::Not(testing::StartsWith(".fusee-"))) << call;
  }
  EXPECT_GT(old_sets, 4);  // staging alone makes more than four calls
  EXPECT_GT(new_sets, 0);
  const bool by_one_exchange = GetParam().exchange && !GetParam().is_current;
  EXPECT_EQ(put_back > 0, GetParam().earlier_run && !by_one_exchange);
}

TEST_P(Kill, FailedCallLeavesOldOrNewSet) {
  // Exit codes of the child: the call was not reached, and the run refused to publish.
  constexpr int k_no_such_call = 7, k_refused = 6;
  const Folder before = with_others(GetParam().earlier_run ? older_ : Folder{}), after = with_others(newer_);
  kills = false;
  int refused = 0;
  for (int call = 1, code = 0; code != k_no_such_call; ++call) {
    const fs::path folder = prepared(call);
    const pid_t child = ::fork();
    if (child == 0) {
      calls_left = call;
      try {
        run_in(folder);
      } catch (const OutputError&) {
        ::_exit(k_refused);
      }
      ::_exit(calls_left > 0 ? k_no_such_call : 0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    code = WEXITSTATUS(status);
    refused += code == k_refused ? 1 : 0;
    // Files that could not be moved back stay aside until the next run.
    publish_set(folder, {{"other.csv", "next"}}, {});
    Folder next = files_in(folder);
    next.erase("other.csv");
    ASSERT_EQ(next, code == k_refused ? before : after) << "call " << call;
  }
  kills = true;
  EXPECT_GT(refused, 4);  // staging alone makes more than four calls
}

INSTANTIATE_TEST_SUITE_P(Grounds, Kill,
                         testing::Values(Ground{"Nothing", false, false, true, false},
                                         Ground{"AnEarlierRun", true, false, true, false},
                                         Ground{"AnEarlierRunAndOthers", true, true, true, false},
                                         Ground{"NoExchange", true, false, false, false},
                                         Ground{"NoExchangeAndOthers", true, true, false, false},
                                         Ground{"CurrentFolder", true, true, true, true},
                                         Ground{"CurrentFolderWithoutExchange", true, true, false, true}),
                         [](const auto& ground) { return std::string(ground.param.name); });

}  // namespace
}  // namespace fusee
