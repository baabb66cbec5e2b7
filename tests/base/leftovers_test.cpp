// Recovery ignores or restores leftovers, whoever made them.

#include "base/leftovers.h"

#include <gmock/gmock.h>
#include <sys/file.h>

#include <optional>
#include <random>

#include "base/descriptor.h"
#include "fuzz/output_folder_laws.h"

namespace fusee {
namespace {

using ::testing::HasSubstr;

class Leftovers : public ::testing::Test {
 protected:
  void SetUp() override { renew(); }
  void TearDown() override { std::filesystem::remove_all(root_); }

  void renew() {
    if (!root_.empty()) std::filesystem::remove_all(root_);
    std::string pattern = (std::filesystem::path(::testing::TempDir()) / "fusee_left_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    root_ = pattern;
  }
  /// A leftover of `out`, with an old/ folder that holds one file.
  std::filesystem::path leftover(const char* file) const {
    const std::string key = staging_key(root_ / "out", StagingSite::beside);
    // 3999999 is the number of a process that does not run.
    const std::filesystem::path folder = root_ / (".fusee-3999999-" + key + "-aaaaaa");
    std::filesystem::create_directories(folder / "old");
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
    std::ofstream(folder / "old" / file) << "mine";
    return folder;
  }

  std::filesystem::path root_;
};

TEST_F(Leftovers, NeverReachOutside) {
  std::mt19937 random(40);
  for (int trial = 0; trial < 100; ++trial) {
    std::string bytes(4 * (1 + random() % 24), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    renew();
    ASSERT_EQ(fusee::testing::broken_publishing_law(root_, bytes), "") << "trial " << trial;
  }
}

TEST_F(Leftovers, RestoreMissingFolder) {
  leftover("notes.txt");
  const std::vector<Diagnostic> notes = recover_leftovers(root_ / "out");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].message, ::testing::EndsWith("out: what a killed run had set aside was put back"));
  EXPECT_TRUE(std::filesystem::exists(root_ / "out" / "notes.txt"));
}

TEST_F(Leftovers, NeverOverwrite) {
  const std::filesystem::path folder = leftover("notes.txt");
  std::filesystem::create_directory(root_ / "out");
  std::ofstream(root_ / "out" / "notes.txt") << "newer";
  recover_leftovers(root_ / "out");
  EXPECT_EQ(fusee::testing::tree_of(root_ / "out").at("notes.txt"), "100644 newer");
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST_F(Leftovers, ReportUntrustedFolder) {
  const std::filesystem::path folder = leftover("notes.txt");
  std::filesystem::permissions(folder, std::filesystem::perms::group_read, std::filesystem::perm_options::add);
  const std::vector<Diagnostic> notes = recover_leftovers(root_ / "out");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].message, HasSubstr("is ignored: it is not a staging folder of yours"));
  EXPECT_TRUE(std::filesystem::exists(folder / "old" / "notes.txt"));
}

TEST_F(Leftovers, KeepStagingOfLivingRuns) {
  const std::filesystem::path folder = leftover("notes.txt");
  const Descriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY));
  ASSERT_EQ(::flock(lock.number(), LOCK_EX), 0);
  recover_leftovers(root_ / "out");
  EXPECT_TRUE(std::filesystem::exists(folder / "old" / "notes.txt"));
}

TEST_F(Leftovers, KeepStagingOfOtherPlaces) {
  const std::filesystem::path folder = leftover("notes.txt");
  EXPECT_THAT(recover_leftovers(root_ / "other"), ::testing::IsEmpty());
  EXPECT_TRUE(std::filesystem::exists(folder / "old" / "notes.txt"));
}

}  // namespace
}  // namespace fusee
