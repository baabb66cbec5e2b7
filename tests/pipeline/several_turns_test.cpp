// Joints whose pulleys turn further than once: what is made, what is refused, and in which words.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "fusee/base/diagnostics.h"
#include "fusee/pipeline.h"
#include "fusee/pipeline/kit.h"

namespace {

using namespace fusee;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

MechanismFile read_profile(const std::string& name, const std::vector<Setting>& settings = {}) {
  return read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / (name + ".toml"), settings);
}

BuildResult made(const MechanismFile& file) {
  BuildOptions options;
  options.folder = std::filesystem::temp_directory_path() / "fusee-several-turns";
  options.dry_run = true;
  return build(file, options);
}

std::string failures_of(const BuildResult& built) {
  std::string text;
  for (const Condition& condition : built.product.synthesis.conditions)
    if (!condition.ok) text += condition.message + "\n";
  for (const Condition& condition : built.product.pulley.conditions)
    if (!condition.ok) text += condition.message + "\n";
  for (const Check& check : built.product.checks)
    if (!check.ok) text += check.name + " " + std::to_string(check.value) + " " + check.where + "\n";
  return text;
}

std::string text_of(const BuildResult& built, const std::string& name) {
  for (const OutputFile& output : built.outputs)
    if (output.name == name) return output.bytes;
  return "";
}

class SeveralTurns : public ::testing::TestWithParam<std::string> {};

TEST_P(SeveralTurns, AreMadeAndGiveTheDeclaredLaw) {
  const BuildResult built = made(read_profile(GetParam()));
  ASSERT_EQ(built.status, BuildStatus::done) << failures_of(built);
  ASSERT_TRUE(built.product.helix);
  EXPECT_GT(built.product.helix->synthesis.sides[0].turns, 2.5);
  EXPECT_LT(degrees(built.product.as_built.max_theta_error), 0.01);
  EXPECT_LT(built.product.as_built.max_slack, 0.02);
  EXPECT_LT(degrees(built.product.helix->as_built.max_fleet), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Profiles, SeveralTurns, ::testing::Values("wrist_turns", "elbow_capstan"),
                         [](const auto& which) { return which.param; });

TEST(SeveralTurnsFiles, SayWhereTheCurvesClimb) {
  const BuildResult built = made(read_profile("wrist_turns"));
  ASSERT_EQ(built.status, BuildStatus::done) << failures_of(built);
  std::istringstream profile(text_of(built, "profile.csv"));
  std::string header, row;
  std::getline(profile, header);
  EXPECT_THAT(header, HasSubstr("normal_deg,turn_deg,z_mm"));
  std::getline(profile, row);
  EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
  EXPECT_THAT(text_of(built, "transmission.csv"), HasSubstr("slope1_deg,fleet1_deg,slope2_deg,fleet2_deg"));
  EXPECT_THAT(text_of(built, "manifest.json"), HasSubstr("joint_end_z_mm"));
  EXPECT_THAT(text_of(built, "report.html"), HasSubstr("wound several times"));
  for (const char* none : {"pulley.scad", "profile.dxf", "plates.dxf"}) EXPECT_EQ(text_of(built, none), "") << none;
}

TEST(SeveralTurnsWords, SayWhatKeepsToOneTurn) {
  EXPECT_THAT(failures_of(made(read_profile("wrist_turns", {{"pulley.winding", "one_turn"}}))),
              HasSubstr("more than one turn (pulley.winding = \"one_turn\")"));
  EXPECT_THAT(failures_of(made(read_profile("wrist_turns", {{"identified.backlash_deg", "0.1"}}))),
              HasSubstr("of a joint with [identified] none is made yet"));
}

TEST(SeveralTurnsWords, RefuseWithAdviceThatBuilds) {
  const BuildResult built = made(read_profile("wrist_turns", {{"body.lead_mm", "1.2"}}));
  ASSERT_EQ(built.status, BuildStatus::infeasible);
  EXPECT_THAT(failures_of(built), HasSubstr("is too small"));
  EXPECT_FALSE(built.advice.empty());
}

/// Of what a body of several turns refuses: the number that is named builds.
TEST(SeveralTurnsWords, BodiesAreRefusedWithNumbersThatBuild) {
  const std::vector<Setting> pocket{{"tendon.diameter_mm", "1.07"}, {"body.knot_pocket_mm", "7"}};
  const BuildResult built = made(read_profile("elbow_capstan", pocket));
  ASSERT_EQ(built.status, BuildStatus::infeasible);
  EXPECT_THAT(failures_of(built), HasSubstr("knot pocket"));
  const auto change = std::find_if(built.advice.alone.begin(), built.advice.alone.end(),
                                   [](const Change& one) { return one.key == "body.knot_pocket_mm"; });
  ASSERT_NE(change, built.advice.alone.end());
  std::vector<Setting> mended = pocket;
  mended.back().value = std::to_string(change->to);
  EXPECT_EQ(made(read_profile("elbow_capstan", mended)).status, BuildStatus::done);
}

/// Each once left a body that crossed itself, or broke through its rim.
TEST(SeveralTurnsBodies, ThatOnceWentWrong) {
  const std::vector<std::vector<Setting>> designs{
      {{"tendon.diameter_mm", "0.72"}, {"pulley.r1_mm", "6.61"}, {"body.spare_turns", "1.7"}},
      {{"tendon.diameter_mm", "0.9"}, {"body.anchor_hole_mm", "2"}}};
  for (const std::vector<Setting>& settings : designs) {
    const BuildResult built = made(read_profile("elbow_capstan", settings));
    EXPECT_EQ(built.status, BuildStatus::done) << settings.front().value << "\n" << failures_of(built);
  }
  // Turns of one normal lie far aside of one another.
  const BuildResult aside = made(read_profile("wrist_turns", {{"pulley.ratio", "6.71"},
                                                              {"joint.length_mm", "246.3"},
                                                              {"guides.EB_mm", "136.6"},
                                                              {"guides.ED_mm", "159.3"},
                                                              {"pulley.EF_mm", "162.2"},
                                                              {"joint.range_deg", "[-35.3, 29.7]"},
                                                              {"body.groove", "u"}}));
  EXPECT_EQ(aside.status, BuildStatus::done) << failures_of(aside);
}

TEST(SeveralTurnsWords, AKitIsNotMade) {
  KitOptions options;
  options.folder = std::filesystem::temp_directory_path() / "fusee-several-turns-kit";
  options.dry_run = true;
  try {
    kit(read_profile("wrist_turns"), options);
    FAIL() << "a kit was made";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the test model is of one turn"));
  }
}

}  // namespace
