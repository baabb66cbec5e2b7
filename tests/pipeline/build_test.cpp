// The whole way: every mechanism of profiles/ becomes checked files, and nothing stays behind when it does not.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>

#include "fusee/pipeline.h"

namespace {

using namespace fusee;
using ::testing::Each;
using ::testing::Field;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

const fs::path k_profiles = fs::path(FUSEE_SOURCE_DIR) / "profiles";

class Build : public ::testing::Test {
 protected:
  Build() {
    std::string name = (fs::temp_directory_path() / "fusee-build-test-XXXXXX").string();
    scratch_ = ::mkdtemp(name.data());
    file_ = read_mechanism(k_profiles / "forearm.toml");
    options_.folder = scratch_ / "out";
  }
  ~Build() override { fs::remove_all(scratch_); }

  std::vector<std::string> names_in(const fs::path& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
    return names;
  }

  fs::path scratch_;
  MechanismFile file_;
  BuildOptions options_;
};

std::vector<std::string> names_of(const std::vector<Check>& checks) {
  std::vector<std::string> names;
  for (const Check& check : checks) names.push_back(check.name);
  return names;
}

TEST_F(Build, LeavesTheFilesItNames) {
  const BuildResult built = build(file_, options_);
  EXPECT_EQ(built.status, BuildStatus::done);
  EXPECT_TRUE(built.published);
  EXPECT_THAT(names_in(options_.folder), ::testing::UnorderedElementsAreArray(output_names()));
  for (const OutputFile& output : built.outputs) {
    EXPECT_EQ(read_file(options_.folder / output.name, std::size_t{1} << 30), output.bytes) << output.name;
  }
}

TEST_F(Build, NamesEveryCheckOnce) {
  std::vector<std::string> names = names_of(build(file_, options_).product.checks);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

TEST_F(Build, GivesTheSameBytesAgain) {
  const BuildResult first = build(file_, options_);
  options_.folder = scratch_ / "again";
  const BuildResult second = build(file_, options_);
  for (std::size_t i = 0; i < first.outputs.size(); ++i)
    EXPECT_EQ(first.outputs[i].bytes, second.outputs[i].bytes) << first.outputs[i].name;
}

TEST_F(Build, DryRunLeavesNothingAndSaysTheSame) {
  options_.dry_run = true;
  const BuildResult dry = build(file_, options_);
  EXPECT_FALSE(dry.published);
  EXPECT_THAT(names_in(scratch_), IsEmpty());
  options_.dry_run = false;
  EXPECT_EQ(names_of(dry.product.checks), names_of(build(file_, options_).product.checks));
}

TEST_F(Build, StoppedBeforeAnyStepLeavesNothing) {
  struct Stop {};
  int steps = 0;
  options_.before_step = [&steps](std::string_view) { ++steps; };
  build(file_, options_);
  ASSERT_GT(steps, 5);
  fs::remove_all(options_.folder);
  for (int last = 0; last < steps; ++last) {
    options_.before_step = [left = last](std::string_view) mutable {
      if (left-- == 0) throw Stop();
    };
    EXPECT_THROW(build(file_, options_), Stop);
    EXPECT_THAT(names_in(scratch_), IsEmpty()) << "stopped before step " << last;
  }
}

TEST_F(Build, OfWhatCannotBeMadeIsAValue) {
  file_.mechanism.pulley.r1 = 60;
  const BuildResult no_curves = build(file_, options_);
  EXPECT_EQ(no_curves.status, BuildStatus::infeasible);
  EXPECT_THAT(no_curves.outputs, IsEmpty());
  file_ = read_mechanism(k_profiles / "forearm.toml");
  file_.mechanism.body.bore_diameter = 60;
  const BuildResult no_body = build(file_, options_);
  EXPECT_EQ(no_body.status, BuildStatus::infeasible);
  EXPECT_TRUE(no_body.product.synthesis.made());
  EXPECT_THAT(names_in(scratch_), IsEmpty());
}

TEST_F(Build, ThatFailsACheckIsPublishedOnlyWhereNothingIsLost) {
  options_.limits.theta_error = 0;
  const BuildResult first = build(file_, options_);
  EXPECT_EQ(first.status, BuildStatus::check_failed);
  EXPECT_TRUE(first.published);
  EXPECT_FALSE(build(file_, options_).published);
  options_.force = true;
  EXPECT_TRUE(build(file_, options_).published);
}

TEST_F(Build, ByThePapersMethodReportsItsSlack) {
  file_.mechanism.pulley.method = Method::paper;
  const BuildResult built = build(file_, options_);
  EXPECT_EQ(built.status, BuildStatus::done);
  EXPECT_GT(built.product.as_built.max_slack, 0.05);
  EXPECT_THAT(names_of(built.product.checks),
              ::testing::AllOf(::testing::Contains("slack_reported"), ::testing::Not(::testing::Contains("slack"))));
}

class Profiles : public Build, public ::testing::WithParamInterface<fs::path> {};

TEST_P(Profiles, IsBuiltAndHoldsEveryCheck) {
  const BuildResult built = build(read_mechanism(GetParam()), options_);
  EXPECT_EQ(built.status, BuildStatus::done);
  EXPECT_THAT(built.product.checks, Each(Field(&Check::ok, true)));
}

std::vector<fs::path> profiles() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(k_profiles)) {
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

INSTANTIATE_TEST_SUITE_P(Each, Profiles, ::testing::ValuesIn(profiles()),
                         [](const auto& profile) { return profile.param.stem().string(); });

}  // namespace
