// Replays the fuzzer's corpus: reading ends with a valid run or with an InputError.
#include <gtest/gtest.h>

#include <filesystem>

#include "fusee/base.h"
#include "fuzz/measurement_laws.h"

namespace fusee::measurement {
namespace {

TEST(MeasurementCorpus, ReadsOrRefusesEveryFile) {
  const std::filesystem::path corpus = std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/fuzz/corpus/measurement";
  int read = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    const std::string name = entry.path().filename().string();
    try {
      EXPECT_EQ(testing::broken_law(read_file(entry.path(), 1 << 20)), "") << name;
      EXPECT_NE(name.substr(0, 4), "bad_");
      ++read;
    } catch (const InputError& error) {
      EXPECT_NE(name.substr(0, 5), "good_") << error.what();
      EXPECT_FALSE(error.diagnostics().empty());
      ++refused;
    }
  }
  EXPECT_GE(read, 15);
  EXPECT_GE(refused, 10);
}

// Each law detects a deliberately broken run.
TEST(MeasurementCorpus, LawsDetectBrokenRuns) {
  fusee::measurement::Run run;
  run.samples.resize(3);
  for (std::size_t i = 0; i < 3; ++i) run.samples[i].time = static_cast<double>(i);
  run.has_time = true;
  run.strokes = {{0, 1, 1, 0, false}, {2, 2, -1, 0, false}};
  EXPECT_EQ(testing::broken_law(run), "");
  fusee::measurement::Run other = run;
  other.samples[1].theta = std::nan("");
  EXPECT_EQ(testing::broken_law(other), "an angle is no number");
  other = run;
  other.samples[2].time = 0.5;
  EXPECT_EQ(testing::broken_law(other), "time goes back");
  other = run;
  other.samples[0].after_break = true;
  EXPECT_EQ(testing::broken_law(other), "the log begins again before it began");
  other = run;
  other.strokes[1].first = 1;
  EXPECT_EQ(testing::broken_law(other), "strokes overlap or leave the run");
  other = run;
  other.strokes[0].direction = 0;
  EXPECT_EQ(testing::broken_law(other), "a stroke has no direction");
}

}  // namespace
}  // namespace fusee::measurement
