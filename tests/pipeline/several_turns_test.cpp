// Joints whose pulleys turn further than once: what is made, what is refused, and in which words.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/export/drawings.h"
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
  EXPECT_LT(degrees(built.product.as_built.max_theta_error), 0.0005);
  EXPECT_LT(built.product.as_built.max_slack, 0.02);
  EXPECT_LT(degrees(built.product.helix->as_built.max_fleet), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Profiles, SeveralTurns, ::testing::Values("wrist_turns", "elbow_capstan", "fusee_proper"),
                         [](const auto& which) { return which.param; });

/// A place of a pitch curve in profile.csv, of what the range winds.
struct Place {
  double x = 0, y = 0, turn = 0;
  double radius() const { return x * std::cos(turn) + y * std::sin(turn); }
  double along() const { return y * std::cos(turn) - x * std::sin(turn); }
};

std::map<std::string, std::vector<Place>> curves_in(const std::string& table) {
  std::map<std::string, std::vector<Place>> curves;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (row.at(5) != "1") continue;
    curves[row[0]].push_back({std::stod(row[2]), std::stod(row[3]), radians(std::stod(row.at(7)))});
  }
  return curves;
}

// A string about a barrel of pitch radius 50.3 mm, over a pin of 8 mm, and on the curves in the file: how far the
// barrel has turned follows from how much of the string is wound, and the spring's torque from that. The clockmaker's
// rule is then that the chain's pull times the fusee's radius is the same at every place. (Level strings: 0.02 % is the
// slope's.)
TEST(TheFuseeOfAClock, PullTimesRadiusIsTheSameAllTheWay) {
  constexpr double k_barrel = 50.3, k_pin = 8.3, k_torque = 66.6667;
  const double to_pin = std::hypot(70.0, 180.0);
  const BuildResult built = made(read_profile("fusee_proper"));
  ASSERT_EQ(built.status, BuildStatus::done) << failures_of(built);
  for (const auto& [pulley, curve] : curves_in(text_of(built, "profile.csv"))) {
    const double hand = pulley == "P2" ? 1.0 : -1.0;
    std::vector<double> paid_out;
    double wound = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      if (i > 0) wound += std::hypot(curve[i].x - curve[i - 1].x, curve[i].y - curve[i - 1].y);
      const double out = curve[i].radius() - k_pin;
      paid_out.push_back(wound + hand * (std::sqrt(to_pin * to_pin - out * out) - k_pin * std::asin(out / to_pin)) -
                         curve[i].along());
    }
    // Home is where 400 N mm are held.
    const double home = k_torque * k_barrel / 400.0;
    const auto at_home = std::min_element(curve.begin(), curve.end(), [home](const Place& a, const Place& b) {
      return std::abs(a.radius() - home) < std::abs(b.radius() - home);
    });
    const double from = paid_out[static_cast<std::size_t>(at_home - curve.begin())];
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const double turned = (paid_out[i] - from) / k_barrel;
      const double pull = (400.0 + 50.93 * turned) / k_barrel;
      ASSERT_NEAR(pull * curve[i].radius() / k_torque, 1.0, 5e-4) << pulley << " at " << degrees(turned);
    }
    EXPECT_NEAR(std::max(curve.front().radius(), curve.back().radius()) /
                    std::min(curve.front().radius(), curve.back().radius()),
                2.0, 1e-3);
    EXPECT_NEAR(std::abs(curve.back().turn - curve.front().turn) / k_two_pi, 5.0, 0.02);
  }
}

// The mesh is wound, and what turns it has done the work that is in the spring: 66.67 alpha = 400 theta + 50.93
// theta²/2.
TEST(TheFuseeOfAClock, StoresInTheSpringWhatTurnsIt) {
  const BuildResult built = made(read_profile("fusee_proper"));
  ASSERT_EQ(built.status, BuildStatus::done) << failures_of(built);
  ASSERT_GT(built.product.as_built.points.size(), 50U);
  for (const RewindPoint& point : built.product.as_built.points) {
    const double theta = (std::sqrt(400.0 * 400.0 + 2.0 * 50.93 * 66.6667 * point.alpha) - 400.0) / 50.93;
    EXPECT_NEAR(degrees(point.theta), degrees(theta), 0.0005) << degrees(point.alpha);
  }
}

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
  EXPECT_THAT(text_of(built, "report.html"), HasSubstr("<h2>The tendons climb</h2>"));
  EXPECT_EQ(text_of(built, "plates.dxf"), "");
  EXPECT_THAT(built.product.pulley.layout.notes, Contains(HasSubstr("there is no plates.dxf")));
}

// Both polylines of each groove, as another program sees them: the working arc's turns, and its height from end to end.
TEST(SeveralTurnsFiles, DrawTheSpiralsInSpace) {
  for (const DxfVersion version : {DxfVersion::ac1015, DxfVersion::r12}) {
    BuildOptions options;
    options.folder = std::filesystem::temp_directory_path() / "fusee-several-turns";
    options.dry_run = true;
    options.dxf = version;
    const BuildResult built = build(read_profile("elbow_capstan"), options);
    ASSERT_EQ(built.status, BuildStatus::done) << failures_of(built);
    const Drawing drawing = read_dxf(text_of(built, "profile.dxf"), "profile.dxf");
    for (const std::string layer : {"P1_SPIRAL", "P2_SPIRAL"}) {
      const auto path = std::find_if(drawing.paths.begin(), drawing.paths.end(),
                                     [&](const DrawingPath& one) { return one.layer == layer; });
      ASSERT_NE(path, drawing.paths.end()) << layer;
      EXPECT_TRUE(path->in_space);
      double turned = 0;
      for (std::size_t i = 1; i < path->points.size(); ++i) {
        const Vec2 &a = path->points[i - 1], &b = path->points[i];
        EXPECT_NEAR(b.norm(), 7.0, 1e-6);
        turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
      }
      // 110° at 12.9 turns of the pulley per turn of the joint: 1419°.
      EXPECT_NEAR(std::abs(degrees(turned)), 110.0 * 12.9, 1.0) << layer;
    }
  }
}

TEST(SeveralTurnsFiles, AreAProgramThatKnowsBothGrooves) {
  const BuildResult built = made(read_profile("fusee_proper"));
  const std::string program = text_of(built, "pulley.scad");
  for (const char* has : {"\nP1 = [", "\nP2 = [", "module run_out", "module bore_hole", "module screw_hole"})
    EXPECT_THAT(program, HasSubstr(has));
  for (const char* none : {"module channel", "//= ", "face_holes"}) EXPECT_THAT(program, Not(HasSubstr(none)));
}

// 4.5° at most: 1/cos and 1/cos³ of it.
TEST(SeveralTurnsWords, SayHowMuchLevelTendonsLeaveOut) {
  const auto note_of = [](const std::vector<Setting>& settings) {
    std::string text;
    for (const Diagnostic& one : analyze(read_profile("wrist_turns", settings)).warnings)
      text += one.message;
    return text;
  };
  EXPECT_THAT(note_of({}), HasSubstr("slope by up to 4.5°: that makes tensions up to 0.31 % larger, and what they give "
                                     "way by up to 0.93 %"));
}

TEST(SeveralTurnsWords, SayWhatKeepsToOneTurn) {
  EXPECT_THAT(failures_of(made(read_profile("wrist_turns", {{"pulley.winding", "one_turn"}}))),
              HasSubstr("more than one turn (pulley.winding = \"one_turn\")"));
  EXPECT_THAT(failures_of(made(read_profile("wrist_turns", {{"identified.backlash_deg", "0.1"}}))),
              HasSubstr("of a joint with [identified] none is made yet"));
}

/// Nothing else stands against this joint: the ratio that is advised builds.
TEST(SeveralTurnsWords, SheathsKeepToOneTurnAndSayWhichRatioBuilds) {
  const BuildResult built = made(read_profile("wrist_sheath", {{"pulley.ratio", "13"}}));
  ASSERT_EQ(built.status, BuildStatus::infeasible);
  EXPECT_THAT(failures_of(built),
              HasSubstr("more than one turn (a tendon out of a sheath is not wound several times yet)"));
  EXPECT_FALSE(built.advice.empty());
  EXPECT_EQ(made(read_profile("wrist_sheath", {{"pulley.ratio", "4.55"}})).status, BuildStatus::done);
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
