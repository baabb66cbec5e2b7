#include <gmock/gmock.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fusee/base.h"

namespace fusee {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string bytes_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void put(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

/// Sorted names in a folder, hidden entries included.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// A manifest in fusee's format.
OutputFile manifest_of(const std::vector<OutputFile>& files) {
  nlohmann::json manifest = {{"schema", 1}, {"tool", "fusee 0.1.0"}, {"outputs", nlohmann::json::array()}};
  for (const OutputFile& file : files) {
    manifest["outputs"].push_back({{"file", file.name}, {"bytes", file.bytes.size()}, {"sha256", sha256(file.bytes)}});
  }
  return {"manifest.json", manifest.dump()};
}

/// One complete run.
void publish(const fs::path& folder, const std::vector<OutputFile>& files, bool force = false) {
  OutputFolder output(folder, force);
  output.stage(manifest_of(files));
  for (const OutputFile& file : files) output.stage(file);
  std::vector<Diagnostic> notes;
  output.publish(notes);
}

/// The message of the thrown OutputError; "" when nothing is thrown.
template <class Action>
std::string output_error(Action action) {
  try {
    action();
  } catch (const OutputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "";
}

template <class Action>
std::string input_error(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class Files : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::path(testing::TempDir()) / "fusee_files_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    root_ = pattern;
  }
  void TearDown() override { fs::remove_all(root_); }

  fs::path root_;
  std::vector<Diagnostic> notes_;  ///< notes of the last run
};

/// Makes `folder` the current folder while the object lives, so that no other folder can replace it. Tests with a
/// variable `whole` run twice: a run replaces the folder as a whole, or, as the current folder, file by file.
class CurrentFolder {
 public:
  explicit CurrentFolder(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~CurrentFolder() { fs::current_path(before_); }

 private:
  fs::path before_;
};

// ---- reading --------------------------------------------------------------------------------------------------------

TEST_F(Files, ReadsBytesAsTheyAre) {
  const std::string bytes("a\0b\r\n\xff", 6);
  put(root_ / "f", bytes);
  EXPECT_EQ(read_file(root_ / "f", 6), bytes);
  put(root_ / "empty", "");
  EXPECT_EQ(read_file(root_ / "empty", 0), "");
}

TEST_F(Files, ReadsFilesWithoutReportedSize) {
  EXPECT_THAT(read_file("/proc/self/status", 1 << 20), HasSubstr("Pid:"));
  EXPECT_THAT(input_error([] { read_file("/proc/self/status", 10); }), HasSubstr("is larger than 10 bytes"));
}

TEST_F(Files, RejectsNonRegularFiles) {
  EXPECT_THAT(input_error([&] { read_file(root_ / "missing", 10); }),
              HasSubstr("missing: error: cannot be read: No such file"));
  EXPECT_THAT(input_error([&] { read_file(root_, 10); }), HasSubstr("is a directory"));
  EXPECT_THAT(input_error([&] { read_file("/dev/zero", 10); }), HasSubstr("is not a regular file"));
  EXPECT_THAT(input_error([&] { read_file("", 10); }), HasSubstr("cannot be read"));
  ASSERT_EQ(mkfifo((root_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(input_error([&] { read_file(root_ / "pipe", 10); }), HasSubstr("is not a regular file"));
}

TEST_F(Files, RejectsLargeFilesBeforeReading) {
  put(root_ / "large", "");
  fs::resize_file(root_ / "large", std::uintmax_t{1} << 40);  // sparse file without blocks
  EXPECT_THAT(input_error([&] { read_file(root_ / "large", 1000); }), HasSubstr("is larger than 1000 bytes"));
  put(root_ / "just", "1234567");
  EXPECT_THAT(input_error([&] { read_file(root_ / "just", 6); }), HasSubstr("is larger than 6 bytes"));
}

TEST(Sha256, MatchesKnownVectors) {  // FIPS 180-2, appendix B
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// ---- a folder of outputs --------------------------------------------------------------------------------------------

TEST_F(Files, PublishesIntoANewFolder) {
  const fs::path folder = root_ / "a" / "b";
  {
    OutputFolder output(folder, false);
    EXPECT_FALSE(output.has_earlier_run());
    EXPECT_FALSE(fs::exists(root_ / "a"));
    output.stage({"x.stl", "xyz"});
    EXPECT_EQ(bytes_of(output.staged_path("x.stl")), "xyz");
    EXPECT_FALSE(fs::exists(folder / "x.stl"));
    output.publish(notes_);
  }
  EXPECT_THAT(names_in(folder), ElementsAre("x.stl"));
  EXPECT_EQ(bytes_of(folder / "x.stl"), "xyz");
}

TEST_F(Files, LeavesNothingWithoutPublishing) {
  { OutputFolder(root_ / "a" / "b", false).stage({"x.stl", "xyz"}); }
  EXPECT_THAT(names_in(root_), IsEmpty());
  fs::create_directory(root_ / "mine");
  { OutputFolder(root_ / "mine", false).stage({"x.stl", "xyz"}); }
  EXPECT_THAT(names_in(root_ / "mine"), IsEmpty());
}

// Other threads may still call staged_path() when a request to stop removes the files. This once crashed (signal 11).
TEST_F(Files, StopRemovesStagedFiles) {
  std::stop_source source;
  OutputFolder output(root_ / "a" / "b", false, {.stop = source.get_token()});
  output.stage({"x.stl", "xyz"});
  const fs::path staged = output.staged_path("x.stl");
  source.request_stop();
  EXPECT_THAT(names_in(root_), IsEmpty());
  EXPECT_EQ(output.staged_path("x.stl"), staged);
  EXPECT_THROW(output.stage({"y.stl", "xyz"}), Stopped);
  std::vector<Diagnostic> notes;
  EXPECT_THROW(output.publish(notes), Stopped);
  EXPECT_THAT(names_in(root_), IsEmpty());
}

TEST_F(Files, StopKeepsPublishedFiles) {
  std::stop_source source;
  OutputFolder output(root_ / "a", false, {.stop = source.get_token()});
  output.stage({"x.stl", "xyz"});
  std::vector<Diagnostic> notes;
  output.publish(notes);
  source.request_stop();
  EXPECT_THAT(names_in(root_ / "a"), ElementsAre("x.stl"));
}

TEST_F(Files, TemporaryFolderLeavesNothing) {
  ::setenv("TMPDIR", root_.c_str(), 1);
  {
    OutputFolder output = OutputFolder::temporary({});
    output.stage({"x.stl", "xyz"});
    EXPECT_EQ(read_file(output.staged_path("x.stl"), 3), "xyz");
  }
  EXPECT_THAT(names_in(root_), IsEmpty());
  ::setenv("TMPDIR", (root_ / "missing").c_str(), 1);
  EXPECT_THAT(output_error([] { OutputFolder::temporary({}); }), HasSubstr("is no folder"));
  ::unsetenv("TMPDIR");
}

TEST_F(Files, OverwritesOwnFiles) {
  publish(root_ / "out", {{"x.stl", "old"}, {"y.obj", "same"}});
  EXPECT_TRUE(OutputFolder(root_ / "out", false).has_earlier_run());
  publish(root_ / "out", {{"x.stl", "new"}, {"y.obj", "same"}});
  EXPECT_EQ(bytes_of(root_ / "out" / "x.stl"), "new");
  EXPECT_THAT(names_in(root_ / "out"), ElementsAre("manifest.json", "x.stl", "y.obj"));
}

TEST_F(Files, RejectsForeignFiles) {
  fs::create_directory(root_ / "out");
  put(root_ / "out" / "x.stl", "theirs");
  put(root_ / "out" / "notes.txt", "theirs");
  EXPECT_THAT(
      output_error([&] {
        publish(root_ / "out", {{"x.stl", "new"}});
      }),
      HasSubstr(
          "files that fusee did not write: x.stl | choose another folder with -o, or overwrite them with --force"));
  EXPECT_EQ(bytes_of(root_ / "out" / "x.stl"), "theirs");
  EXPECT_THAT(names_in(root_ / "out"), ElementsAre("notes.txt", "x.stl"));
  publish(root_ / "out", {{"x.stl", "new"}}, /*force=*/true);
  EXPECT_EQ(bytes_of(root_ / "out" / "x.stl"), "new");
  EXPECT_EQ(bytes_of(root_ / "out" / "notes.txt"), "theirs");
}

TEST_F(Files, RejectsChangedFiles) {
  publish(root_ / "out", {{"x.stl", "old"}, {"y.obj", "same"}});
  put(root_ / "out" / "x.stl", "edited by hand");
  EXPECT_THAT(output_error([&] {
                publish(root_ / "out", {{"x.stl", "new"}, {"y.obj", "other"}});
              }),
              HasSubstr("files that were changed after fusee wrote them: x.stl |"));
  EXPECT_EQ(bytes_of(root_ / "out" / "x.stl"), "edited by hand");
  EXPECT_EQ(bytes_of(root_ / "out" / "y.obj"), "same");
  publish(root_ / "out", {{"x.stl", "new"}}, /*force=*/true);
  EXPECT_EQ(bytes_of(root_ / "out" / "x.stl"), "new");
}

TEST_F(Files, ClaimListsAllConflictsAndWritesNothing) {
  publish(root_ / "out", {{"x.stl", "old"}});
  put(root_ / "out" / "x.stl", "edited");
  put(root_ / "out" / "z.csv", "foreign");
  OutputFolder output(root_ / "out", false);
  const std::string error = output_error([&] { output.claim({"x.stl", "y.obj", "z.csv", "manifest.json"}); });
  EXPECT_THAT(error, HasSubstr("did not write: z.csv; and files that were changed after fusee wrote them: x.stl |"));
  EXPECT_THAT(names_in(root_ / "out"), ElementsAre("manifest.json", "x.stl", "z.csv"));
  OutputFolder elsewhere(root_ / "new", false);
  elsewhere.claim({"x.stl"});
  EXPECT_FALSE(fs::exists(root_ / "new"));
}

TEST_F(Files, BrokenManifestIsForeign) {
  for (const std::string& manifest :
       {std::string("{\"tool\":\"fusee"), std::string("{\"tool\":\"npm\",\"outputs\":[]}"), std::string("[]"),
        std::string("{}"), std::string("{\"tool\":\"fusee\",\"outputs\":{}}"), std::string(200000, '['),
        std::string("\xff")}) {
    fs::create_directory(root_ / "out");
    put(root_ / "out" / "manifest.json", manifest);
    EXPECT_FALSE(OutputFolder(root_ / "out", false).has_earlier_run()) << manifest.substr(0, 40);
    EXPECT_THAT(output_error([&] {
                  publish(root_ / "out", {{"x.stl", "new"}});
                }),
                HasSubstr("did not write: manifest.json"));
    EXPECT_EQ(bytes_of(root_ / "out" / "manifest.json"), manifest);
    fs::remove_all(root_ / "out");
  }
}

TEST_F(Files, NeverReplacesNonRegularFile) {
  fs::create_directories(root_ / "out" / "x.stl");
  EXPECT_THAT(output_error([&] {
                publish(root_ / "out", {{"x.stl", "new"}}, /*force=*/true);
              }),
              HasSubstr("is not a regular file"));
  EXPECT_TRUE(fs::is_directory(root_ / "out" / "x.stl"));
}

TEST_F(Files, RejectsFileAsFolder) {
  put(root_ / "file", "bytes");
  for (const fs::path& folder : {root_ / "file", root_ / "file" / "below", root_ / "file" / "below" / "further"}) {
    EXPECT_THAT(output_error([&] {
                  publish(folder, {{"x.stl", "new"}});
                }),
                HasSubstr("file is not a folder"))
        << folder;
    EXPECT_THAT(output_error([&] { OutputFolder(folder, false).claim({"x.stl"}); }), HasSubstr("file is not a folder"));
  }
  EXPECT_EQ(bytes_of(root_ / "file"), "bytes");
}

TEST_F(Files, UnwritableFolderIsOutputError) {
  // In /proc no user can create files, not even root.
  EXPECT_NE(output_error([&] { publish("/proc", {{"x.stl", "new"}}); }), "");
  EXPECT_NE(output_error([&] { publish("/proc/fusee/out", {{"x.stl", "new"}}); }), "");
  EXPECT_NE(output_error([&] { write_file("/proc/x.stl", "new", false); }), "");
}

TEST_F(Files, FullDiskKeepsEarlierFiles) {
  // A file system of 1 MB, mounted for this process only.
  const fs::path disk = root_ / "disk";
  fs::create_directory(disk);
  const bool alone = ::unshare(CLONE_NEWNS) == 0 && ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
  if (!alone || ::mount("fusee", disk.c_str(), "tmpfs", 0, "size=1m") != 0) GTEST_SKIP() << "may not mount";
  publish(disk / "out", {{"x.stl", "old"}});
  const std::vector<std::string> before = names_in(disk / "out");
  const std::string error = output_error([&] {
    publish(disk / "out", {{"a.obj", "small"}, {"x.stl", std::string(4 << 20, 'x')}});
  });
  const std::string content = bytes_of(disk / "out" / "x.stl");
  const std::vector<std::string> after = names_in(disk / "out");
  ::umount(disk.c_str());
  EXPECT_THAT(error, HasSubstr("the disk is full"));
  EXPECT_EQ(content, "old");
  EXPECT_EQ(after, before);
}

/// Runs `action` in a child process and kills the child when it stops itself.
template <class Action>
void kill_after(Action action) {
  const pid_t child = ::fork();
  if (child == 0) {
    action();
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
}

TEST_F(Files, NextRunRemovesLeftovers) {
  publish(root_ / "out", {{"x.stl", "old"}});
  kill_after([&] {
    OutputFolder* output = new OutputFolder(root_ / "out", false);
    output->stage({"x.stl", "half"});
  });
  EXPECT_THAT(names_in(root_ / "out"), ElementsAre("manifest.json", "x.stl"));
  EXPECT_EQ(names_in(root_).size(), 2u);  // the staging folder still exists
  EXPECT_EQ(bytes_of(root_ / "out" / "x.stl"), "old");
  publish(root_ / "out", {{"x.stl", "new"}});
  EXPECT_THAT(names_in(root_ / "out"), ElementsAre("manifest.json", "x.stl"));
  EXPECT_THAT(names_in(root_), ElementsAre("out"));
}

TEST_F(Files, KeepsStagingOfLivingRun) {
  OutputFolder living(root_ / "out", false);
  living.stage({"x.stl", "mine"});
  publish(root_ / "out", {{"y.obj", "other"}});
  EXPECT_EQ(bytes_of(living.staged_path("x.stl")), "mine");
  living.publish(notes_);
  EXPECT_EQ(bytes_of(root_ / "out" / "x.stl"), "mine");
}

TEST_F(Files, KeepsOtherEntries) {
  publish(root_ / "out", {{"x.stl", "old"}});
  put(root_ / "out" / "notes.txt", "mine");
  put(root_ / "out" / ".hidden", "mine");
  fs::create_symlink("nowhere", root_ / "out" / "link");
  fs::permissions(root_ / "out", fs::perms::owner_all | fs::perms::group_read);
  const auto inode = [&](const char* name) {
    struct stat status {};
    ::lstat((root_ / "out" / name).c_str(), &status);
    return status.st_ino;
  };
  const auto notes = inode("notes.txt");
  publish(root_ / "out", {{"x.stl", "new"}});
  EXPECT_THAT(names_in(root_ / "out"), ElementsAre(".hidden", "link", "manifest.json", "notes.txt", "x.stl"));
  EXPECT_EQ(inode("notes.txt"), notes);  // the inode is kept, for editors that hold the file open
  EXPECT_EQ(fs::status(root_ / "out").permissions(), fs::perms::owner_all | fs::perms::group_read);
  EXPECT_THAT(names_in(root_), ElementsAre("out"));
}

TEST_F(Files, KeepsCurrentFolder) {
  publish(root_ / "out", {{"x.stl", "old"}});
  {
    const CurrentFolder current(root_ / "out");
    publish(".", {{"x.stl", "new"}});
    EXPECT_EQ(bytes_of("x.stl"), "new");  // the current folder keeps its name
    EXPECT_TRUE(fs::equivalent(".", root_ / "out"));
  }
  EXPECT_THAT(names_in(root_ / "out"), ElementsAre("manifest.json", "x.stl"));
}

TEST_F(Files, KeepsLinkToFolder) {
  publish(root_ / "out", {{"x.stl", "old"}});
  fs::create_directory_symlink("out", root_ / "link");
  publish(root_ / "link", {{"x.stl", "new"}});
  EXPECT_TRUE(fs::is_symlink(root_ / "link"));
  EXPECT_EQ(bytes_of(root_ / "out" / "x.stl"), "new");
}

TEST_F(Files, RemovesWithdrawnFiles) {
  for (const bool whole : {true, false}) {
    const fs::path folder = root_ / (whole ? "whole" : "current");
    publish(folder, {{"x.stl", "old"}, {"p1.stl", "old"}, {"p2.stl", "old"}});
    put(folder / "p2.stl", "edited");
    std::optional<CurrentFolder> current;
    if (!whole) current.emplace(folder);
    OutputFolder output(folder, false);
    output.stage(manifest_of({{"x.stl", "new"}}));
    output.stage({"x.stl", "new"});
    output.withdraw({"x.stl", "p1.stl", "p2.stl", "p3.stl"});
    output.publish(notes_);
    EXPECT_EQ(bytes_of(folder / "x.stl"), "new");
    EXPECT_FALSE(fs::exists(folder / "p1.stl"));
    EXPECT_EQ(bytes_of(folder / "p2.stl"), "edited");
  }
}

TEST_F(Files, SubfolderKeepsEditedFiles) {
  for (const bool whole : {true, false}) {
    const fs::path folder = root_ / (whole ? "whole" : "current");
    publish(folder, {{"next/page.html", "old"}, {"next/run_1.csv", "old"}, {"next/run_2.csv", "old"}});
    put(folder / "next/run_2.csv", "filled in");
    fs::create_directories(folder / "next/mine");
    put(folder / "next/mine/notes.txt", "mine");
    std::optional<CurrentFolder> current;
    if (!whole) current.emplace(folder);
    for (const bool has_page : {true, false}) {
      OutputFolder output(folder, false);
      output.stage(has_page ? manifest_of({{"next/page.html", "new"}}) : manifest_of({}));
      if (has_page) output.stage({"next/page.html", "new"});
      output.withdraw({"next/page.html", "next/run_1.csv", "next/run_2.csv"});
      output.publish(notes_);
      EXPECT_EQ(fs::exists(folder / "next/page.html"), has_page);
      EXPECT_FALSE(fs::exists(folder / "next/run_1.csv"));
      EXPECT_EQ(bytes_of(folder / "next/run_2.csv"), "filled in");
      EXPECT_EQ(bytes_of(folder / "next/mine/notes.txt"), "mine");
    }
  }
}

TEST_F(Files, RemovesEmptiedSubfolder) {
  for (const bool whole : {true, false}) {
    const fs::path folder = root_ / (whole ? "whole" : "current");
    publish(folder, {{"x.stl", "old"}, {"next/run_1.csv", "old"}});
    std::optional<CurrentFolder> current;
    if (!whole) current.emplace(folder);
    OutputFolder output(folder, false);
    output.stage(manifest_of({{"x.stl", "new"}}));
    output.stage({"x.stl", "new"});
    output.withdraw({"next/run_1.csv"});
    output.publish(notes_);
    EXPECT_FALSE(fs::exists(folder / "next"));
  }
}

TEST_F(Files, RejectsLinkOrFileAsSubfolder) {
  fs::create_directories(root_ / "elsewhere");
  for (const bool link : {true, false}) {
    const fs::path folder = root_ / (link ? "link" : "file");
    publish(folder, {{"x.stl", "old"}});
    if (link) {
      fs::create_directory_symlink(root_ / "elsewhere", folder / "next");
    } else {
      put(folder / "next", "mine");
    }
    EXPECT_THROW(publish(folder, {{"next/run_1.csv", "new"}}), OutputError);
    EXPECT_EQ(bytes_of(folder / "x.stl"), "old");
  }
  EXPECT_TRUE(fs::is_empty(root_ / "elsewhere"));
}

TEST_F(Files, ConcurrentRunsBothPublish) {
  // Both runs begin before either publishes. Neither may treat the other's files as foreign.
  for (const bool whole : {true, false}) {
    const fs::path folder = root_ / (whole ? "whole" : "current");
    publish(folder, {{"x.stl", "old"}});
    std::optional<CurrentFolder> current;
    if (!whole) current.emplace(folder);
    OutputFolder first(folder, false), second(folder, false);
    for (OutputFolder* output : {&first, &second}) {
      const std::string bytes = output == &first ? "first" : "second";
      output->stage(manifest_of({{"x.stl", bytes}}));
      output->stage({"x.stl", bytes});
    }
    first.publish(notes_);
    second.publish(notes_);
    EXPECT_EQ(bytes_of(folder / "x.stl"), "second");
    EXPECT_EQ(bytes_of(folder / "manifest.json"), manifest_of({{"x.stl", "second"}}).bytes);
  }
}

TEST_F(Files, OutputsHaveDefaultRights) {
  publish(root_ / "out", {{"x.stl", "new"}});
  const mode_t mask = ::umask(0);
  ::umask(mask);
  EXPECT_EQ(static_cast<mode_t>(fs::status(root_ / "out" / "x.stl").permissions()), 0666 & ~mask);
  EXPECT_EQ(static_cast<mode_t>(fs::status(root_ / "out").permissions()), 0777 & ~mask);
}

TEST_F(Files, RejectsEscapingNames) {
  OutputFolder output(root_ / "out", false);
  for (const char* name : {"", "../x", "a/../x", "a/b/c", "a/", "a/.hidden", ".hidden", "/etc/x"})
    EXPECT_THROW(output.stage({name, ""}), Bug) << name;
  output.stage({"x", "1"});
  EXPECT_THROW(output.stage({"x", "2"}), Bug);
}

// ---- one file -------------------------------------------------------------------------------------------------------

TEST_F(Files, WritesOneFile) {
  write_file(root_ / "new" / "x.toml", "one", false);
  EXPECT_EQ(bytes_of(root_ / "new" / "x.toml"), "one");
  EXPECT_THAT(output_error([&] { write_file(root_ / "new" / "x.toml", "two", false); }),
              HasSubstr("x.toml exists | choose another name, or overwrite it with --force"));
  EXPECT_EQ(bytes_of(root_ / "new" / "x.toml"), "one");
  write_file(root_ / "new" / "x.toml", "two", true);
  EXPECT_EQ(bytes_of(root_ / "new" / "x.toml"), "two");
  EXPECT_THAT(names_in(root_ / "new"), ElementsAre("x.toml"));
}

TEST_F(Files, WritesThroughALink) {
  put(root_ / "target", "one");
  fs::create_symlink(root_ / "target", root_ / "link");
  write_file(root_ / "link", "two", true);
  EXPECT_TRUE(fs::is_symlink(root_ / "link"));
  EXPECT_EQ(bytes_of(root_ / "target"), "two");
}

TEST_F(Files, OverwritesRegularFilesOnly) {
  EXPECT_THAT(output_error([&] { write_file(root_, "x", true); }), HasSubstr("is not a regular file"));
  ASSERT_EQ(mkfifo((root_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(output_error([&] { write_file(root_ / "pipe", "x", true); }), HasSubstr("is not a regular file"));
  EXPECT_THAT(output_error([&] { write_file("", "x", true); }), HasSubstr("names no file"));
  for (const char* name : {".", "..", "missing/.", "missing/.."})
    EXPECT_THAT(output_error([&] { write_file(root_ / name, "x", true); }),
                testing::AnyOf(HasSubstr("names no file"), HasSubstr("is not a regular file")))
        << name;
  EXPECT_FALSE(fs::exists(root_ / "missing"));
}

TEST_F(Files, AcceptsNamesWithDots) {
  for (const char* name : {"...", ".hidden.toml", "x..", "..x"}) {
    write_file(root_ / name, "one", false);
    EXPECT_EQ(bytes_of(root_ / name), "one") << name;
  }
  publish(root_ / "out..", {{"x.stl", "new"}});
  publish(root_ / "...out", {{"x.stl", "new"}});
  publish(root_ / "missing" / ".." / "beside", {{"x.stl", "new"}});
  EXPECT_EQ(bytes_of(root_ / "beside" / "x.stl"), "new");
  EXPECT_FALSE(fs::exists(root_ / "missing"));
}

}  // namespace
}  // namespace fusee
