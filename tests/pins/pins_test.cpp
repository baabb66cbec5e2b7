// Equal input gives equal bytes for every output, on every machine and with every compiler. tests/pins/*.sha256 have
// the hashes.
#include <gmock/gmock.h>

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>

#include "export/step/step.h"
#include "pins/hashes.h"
#include "pins/runs.h"

namespace fusee::pins {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

const fs::path k_pins = fs::path(FUSEE_SOURCE_DIR) / "tests/pins";
constexpr std::size_t k_largest_list = 1 << 20;
constexpr const char* k_next_steps =
    "\nTo compare: run `build/release/tests/pins/pins now` here, the same with `before` at the last commit that "
    "passed, then"
    " `diff -r before now`."
    "\nWhere the change is meant: `build/release/tests/pins/pins now && cp now/*.sha256 tests/pins/`, and the commit"
    " says why the bytes moved.";

Hashes pinned_in(const fs::path& hash_file) {
  return fs::exists(hash_file) ? parse_hashes(read_file(hash_file, k_largest_list)) : Hashes();
}

/// The hashes of one run.
Hashes pinned_of(const std::string& run_name) {
  Hashes hashes;
  for (const auto& [path, hash] : pinned_in(k_pins / hash_file_of(run_name))) {
    if (path.rfind(run_name + "/", 0) == 0) hashes[path] = hash;
  }
  return hashes;
}

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += "\n  " + word;
  return text;
}

class Outputs : public ::testing::TestWithParam<PinnedRun> {};

TEST_P(Outputs, MatchPins) {
  const PinnedRun& run = GetParam();
  if (run.name.rfind(k_step_runs, 0) == 0) {
    if (const auto why = formats::step_missing()) GTEST_SKIP() << *why;
  }
  const std::vector<OutputFile> outputs = run.outputs();
  const std::vector<std::string> words = differences(pinned_of(run.name), hashes_of(run.name, outputs));
  EXPECT_TRUE(words.empty()) << list(words) << k_next_steps;
  for (const OutputFile& file : outputs)
    EXPECT_EQ(file.bytes.find(FUSEE_SOURCE_DIR), std::string::npos) << file.name << " contains the path of the sources";
}

std::string test_name(const ::testing::TestParamInfo<PinnedRun>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Commands, Outputs, ::testing::ValuesIn(runs()), test_name);

// Eigen would block its products by the cache sizes, which changes the last digits of sums.
TEST(Pins, IgnoreProcessorCaches) {
  EXPECT_EQ(Eigen::l1CacheSize(), 32 << 10);
  EXPECT_EQ(Eigen::l2CacheSize(), 256 << 10);
  EXPECT_EQ(Eigen::l3CacheSize(), 2 << 20);
}

TEST(Pins, BelongToRuns) {
  const std::vector<PinnedRun> all = runs();
  const auto is_made = [&all](const std::string& path) {
    return std::any_of(all.begin(), all.end(),
                       [&path](const PinnedRun& run) { return path.starts_with(run.name + "/"); });
  };
  for (const auto& entry : fs::directory_iterator(k_pins)) {
    if (entry.path().extension() != ".sha256") continue;
    for (const auto& [path, hash] : pinned_in(entry.path()))
      EXPECT_TRUE(is_made(path)) << path << " is pinned, and no run makes it";
  }
}

TEST(Pins, NameChangedFiles) {
  const std::vector<OutputFile> before = {{"a.txt", "as it was"}, {"b.txt", "b"}, {"c.txt", "c"}};
  const std::vector<OutputFile> after = {{"a.txt", "as it is"}, {"b.txt", "b"}, {"d.txt", "d"}};
  EXPECT_THAT(differences(hashes_of("verb/run", before), hashes_of("verb/run", after)),
              ElementsAre("verb/run/a.txt changed", "verb/run/d.txt is new", "verb/run/c.txt is gone"));
}

TEST(Pins, ReadTheirOwnFiles) {
  const Hashes hashes = hashes_of("verb/run", {{"a.txt", ""}, {"b.txt", "b"}});
  EXPECT_EQ(parse_hashes(text_of(hashes)), hashes);
  EXPECT_THAT(differences(parse_hashes(text_of(hashes)), hashes), IsEmpty());
  // As printed by sha256sum for an empty file.
  EXPECT_EQ(hashes.at("verb/run/a.txt"), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace
}  // namespace fusee::pins
