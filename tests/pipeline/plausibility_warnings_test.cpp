// Plausibility warnings of every verb: in the returned value and in the written files.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "fusee/pipeline.h"

namespace fusee::pipeline {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MechanismFile profile(const std::string& name, const std::vector<Setting>& settings) {
  return read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / (name + ".toml"), settings);
}

/// An overloaded arm whose pins have the wrong sign: they were meant to be above the joint.
MechanismFile faulty_forearm() {
  return profile("forearm", {{"guides.OE_mm", "40"}, {"tendon.strength_N", "20"}, {"load.tip_force_N", "25"}});
}

std::vector<std::string> messages(const std::vector<Diagnostic>& warnings) {
  std::vector<std::string> all;
  for (const Diagnostic& warning : warnings) {
    EXPECT_EQ(warning.severity, Severity::warning);
    all.push_back(warning.message);
  }
  return all;
}

std::string text_of(const std::vector<OutputFile>& outputs, const std::string& name) {
  const auto found =
      std::find_if(outputs.begin(), outputs.end(), [&](const OutputFile& one) { return one.name == name; });
  return found == outputs.end() ? "" : found->bytes;
}

BuildResult built(const MechanismFile& file) {
  BuildOptions options;
  options.folder = std::filesystem::path(::testing::TempDir()) / "fusee_plausibility_warnings";
  options.dry_run = true;
  return build(file, options);
}

TEST(PlausibilityWarnings, AppearInManifestAndReport) {
  const BuildResult result = built(faulty_forearm());
  EXPECT_THAT(messages(result.product.file.warnings),
              ElementsAre(HasSubstr("guides.OE_mm = 40"), HasSubstr("the tendon breaks")));
  EXPECT_THAT(text_of(result.outputs, "manifest.json"),
              AllOf(HasSubstr("guides.OE_mm = 40 mm"), HasSubstr("(tendon.strength_N")));
  EXPECT_THAT(text_of(result.outputs, "report.html"), HasSubstr("guides.OE_mm = 40 mm"));
}

TEST(PlausibilityWarnings, AppearForInfeasibleBuild) {
  const BuildResult result = built(profile("forearm", {{"guides.EB_mm", "5"}}));
  EXPECT_EQ(result.status, BuildStatus::infeasible);
  EXPECT_THAT(messages(result.product.file.warnings), ElementsAre(HasSubstr("guides.EB_mm = 5")));
}

// build() only warns of a breaking tendon; analyze() reports it in breaks_at, as an error.
TEST(PlausibilityWarnings, BreakingTendonIsError) {
  const analysis::AnalysisResult result = analyze(faulty_forearm());
  EXPECT_TRUE(result.breaks_at);
  EXPECT_THAT(messages(result.warnings), ElementsAre(HasSubstr("guides.OE_mm = 40")));
  // An estimated strength gives a warning, not an error.
  const analysis::AnalysisResult likely =
      analyze(profile("forearm", {{"load.tip_force_N", "500"}, {"tendon.diameter_mm", "0.9"}}));
  EXPECT_FALSE(likely.breaks_at);
  EXPECT_THAT(messages(likely.warnings), ElementsAre(HasSubstr("an estimate")));
}

TEST(PlausibilityWarnings, NameTightBends) {
  EXPECT_THAT(messages(analyze(profile("forearm", {{"tendon.bend_ratio", "34"}})).warnings),
              ElementsAre(HasSubstr("P1 bends the tendon"), HasSubstr("P2 bends the tendon")));
}

TEST(PlausibilityWarnings, AppearInOptimization) {
  OptimizeOptions options;
  options.dry_run = true;
  EXPECT_THAT(messages(optimize(profile("paper_optimum", {{"tendon.modulus_MPa", "40"}}), options).warnings),
              ElementsAre(HasSubstr("tendon.modulus_MPa = 40 MPa")));
}

TEST(PlausibilityWarnings, OrdinaryFileHasNone) {
  const MechanismFile file = profile("forearm", {});
  const BuildResult result = built(file);
  EXPECT_THAT(result.product.file.warnings, IsEmpty());
  EXPECT_THAT(analyze(file).warnings, IsEmpty());
  OptimizeOptions options;
  options.dry_run = true;
  EXPECT_THAT(optimize(profile("paper_optimum", {}), options).warnings, IsEmpty());
}

}  // namespace
}  // namespace fusee::pipeline
