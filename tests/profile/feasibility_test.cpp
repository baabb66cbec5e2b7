#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "fusee/mechanism_file.h"
#include "fusee/profile.h"
#include "support/mechanisms.h"

namespace fusee::profile {
namespace {

using ::testing::HasSubstr;

const Condition& failed(const SynthesisResult& result) {
  const auto found =
      std::find_if(result.conditions.begin(), result.conditions.end(), [](const Condition& c) { return !c.ok; });
  EXPECT_NE(found, result.conditions.end()) << "everything holds";
  return *found;
}

/// The mechanism with one change of the advice applied.
Mechanism with(Mechanism mechanism, const Change& change) {
  if (change.key == "joint.range_deg") {
    mechanism.joint.theta_min = -radians(change.to);
    mechanism.joint.theta_max = radians(change.to);
  } else if (change.key == "joint.range_deg[0]") {
    mechanism.joint.theta_min = radians(change.to);
  } else if (change.key == "joint.range_deg[1]") {
    mechanism.joint.theta_max = radians(change.to);
  } else {
    const NumberKey key = *find_number_key(change.key);
    set_number(mechanism, *key.field, key.end, change.to);
  }
  return mechanism;
}

/// Expects a failure of `condition` with `words` in its text, and that every single advice makes the mechanism feasible.
void expect_refused(const Mechanism& mechanism, const std::string& condition, const std::string& words) {
  const SynthesisResult result = synthesise(mechanism);
  ASSERT_FALSE(result.made());
  EXPECT_EQ(failed(result).name, condition);
  EXPECT_THAT(result.brief(), HasSubstr(words));
  EXPECT_FALSE(result.advice.empty()) << result.brief();
  for (const Change& change : result.advice) {
    EXPECT_TRUE(synthesise(with(mechanism, change), {.advice = false}).made()) << change.text;
    EXPECT_THAT(result.brief(), HasSubstr(change.text));
  }
}

TEST(Feasibility, ReportsConcaveReference) {
  Mechanism mechanism = testing::reference();
  mechanism.tendon.diameter = 0.01;
  expect_refused(mechanism, "convex_floor_P2", "P2 would be concave at α = 92");
}

TEST(Feasibility, ReportsHollowWithoutSign) {
  Mechanism mechanism = testing::reference();
  mechanism.tendon.diameter = 0.01;
  const SynthesisResult result = synthesise(mechanism, {.advice = false});
  const double radius = failed(result).value;
  EXPECT_THAT(failed(result).message, HasSubstr(radius > 0 ? "would be too sharp" : "would be concave"));
  EXPECT_THAT(failed(result).message, ::testing::Not(HasSubstr("-")));
}

TEST(Feasibility, ReportsDeadCentre) {
  Mechanism mechanism = testing::forearm();
  mechanism.joint.theta_max = radians(60);
  expect_refused(mechanism, "moment_arms", "dead centre");
}

TEST(Feasibility, ReportsAttachmentInsideDrum) {
  Mechanism mechanism = testing::finger();
  mechanism.joint.attachment2 = Attachment{-5.0, 5.0};  // 8 − √50 = 0.929 mm inside the drum
  expect_refused(mechanism, "attachment_outside_drum_2", "tendon 2 ends 0.929 mm inside the drum");
}

TEST(Feasibility, ReportsPinInDrum) {
  Mechanism mechanism = testing::finger();
  mechanism.guides.radius = 9.5;  // 8 + 9.5 − √(12² + 12²) = 0.529 mm
  expect_refused(mechanism, "drum_clear_of_pin_B", "pin B lies 0.529 mm inside the drum");
}

TEST(Feasibility, ReportsTendonThroughOtherPin) {
  Mechanism mechanism = testing::finger();
  mechanism.joint.drum_radius = 0;
  mechanism.joint.theta_min = radians(-1.0);
  mechanism.joint.theta_max = radians(1.0);
  // Tendon 2 ends far on the left, and passes pin B on its way to pin D.
  mechanism.joint.attachment2 = Attachment{-30.0, 2.0};
  mechanism.guides.OE = -5.0;
  mechanism.guides.EB = 10.0;
  const SynthesisResult result = synthesise(mechanism, {.advice = false});
  ASSERT_FALSE(result.made());
  EXPECT_EQ(failed(result).name, "tendon_2_clear_of_pin_B");
}

TEST(Feasibility, ReportsSheathExitInPulley) {
  Mechanism mechanism = testing::sheathed_wrist();
  mechanism.sheath.exit_across = 5.0;
  mechanism.sheath.exit_above = 12.0;
  expect_refused(mechanism, "line_reaches_mouth_1", "the exit of sheath 1 lies");
  // Farther out, the exit is still so close that the curve would be hollow, or that no line reaches the exit.
  mechanism.sheath.exit_above = 18.0;
  const SynthesisResult too_near = synthesise(mechanism);
  ASSERT_FALSE(too_near.made());
  EXPECT_FALSE(too_near.advice.empty());
}

TEST(Feasibility, ReportsTendonOffPinAtSheath) {
  Mechanism mechanism = testing::sheathed_wrist();
  mechanism.joint.theta_max = radians(36.0);
  mechanism.guides.EB = 35.0;
  expect_refused(mechanism, "tendon_on_pin_B", "down into its sheath, is");
}

// With a sheath, EF only sets where the pulley is drawn.
TEST(Feasibility, AdviceKeepsArbitraryPulleyPosition) {
  Mechanism mechanism = testing::sheathed_wrist();
  mechanism.sheath.exit_above = 12.0;
  for (const Change& change : synthesise(mechanism).advice) EXPECT_NE(change.key, "pulley.EF_mm");
}

/// The radius of P2 is proportional to 1/m1. The slope of the arm m1 jumps up where tendon 1 leaves the drum.
TEST(Feasibility, ReportsHollowAtLiftOffOfTendon1) {
  Mechanism mechanism = testing::finger();
  mechanism.joint.attachment1 = Attachment{-8.3, 8.3};
  expect_refused(mechanism, "convex_at_lift_off_P2", "tendon 1 leaves the drum at α = 21");
  mechanism.pulley.law = Law::linear;
  mechanism.pulley.ratio = 1.0;
  EXPECT_TRUE(synthesise(mechanism).made());
}

TEST(Feasibility, LiftOffOfTendon2MakesStraightPart) {
  Mechanism mechanism = testing::finger();
  // In the mirror image, tendon 2 leaves the drum.
  mechanism.joint.attachment1 = Attachment{-8.3, 8.3};
  mechanism = testing::mirrored(mechanism);
  const SynthesisResult result = synthesise(mechanism);
  ASSERT_TRUE(result.made()) << result.brief();
  double longest = 0;
  const auto& points = result.p2.points;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    longest = std::max(longest, (points[i + 1].position - points[i].position).norm());
  // An edge of √(8 · 0.01 · ρ) mm keeps the chord error of 0.01 mm: less than 4 mm up to ρ = 200 mm.
  EXPECT_GT(longest, 4.0);
}

TEST(Feasibility, ReportsPulleyBeyondPin) {
  Mechanism mechanism = testing::forearm();
  mechanism.pulley.EF = 30.0;
  mechanism.pulley.r1 = 62.0;
  expect_refused(mechanism, "line_reaches_pin_B", "inside the pulley's pitch curve");
}

TEST(Feasibility, ReportsTendonOffPin) {
  Mechanism mechanism = testing::forearm();
  mechanism.pulley.EF = 400.0;
  mechanism.guides.OE = 10.0;
  mechanism.joint.theta_min = radians(-40);
  mechanism.joint.theta_max = radians(40);
  expect_refused(mechanism, "tendon_on_pin_B", "leaves pin B");
}

TEST(Feasibility, ReportsMoreThanOneTurn) {
  Mechanism mechanism = testing::forearm();
  mechanism.pulley.r1 = 9.0;
  const SynthesisResult result = synthesise(mechanism);
  expect_refused(mechanism, "one_turn_P1", "more than one turn");
  EXPECT_TRUE(std::any_of(result.advice.begin(), result.advice.end(),
                          [](const Change& c) { return c.key == "pulley.r1_mm" && c.to > 9.0; }));
}

TEST(Feasibility, ReportsTooSmallRadius) {
  Mechanism mechanism = testing::forearm();
  mechanism.tendon.diameter = 40.0;
  mechanism.guides.radius = 0.0;
  EXPECT_EQ(failed(synthesise(mechanism, {.advice = false})).name, "radius_P1");
}

TEST(Feasibility, RejectsDecreasingTable) {
  Mechanism mechanism = testing::forearm();
  mechanism.pulley.law = Law::table;
  // The rows increase, but the smooth curve through a steep pair and a wide gap overshoots.
  for (const auto& [alpha, theta] : {std::pair{-1.0, -0.30},
                                     {-0.95, -0.20},
                                     {-0.90, -0.19},
                                     {-0.2, -0.15},
                                     {0.0, 0.0},
                                     {0.2, 0.05},
                                     {0.5, 0.1},
                                     {1.0, 0.2}}) {
    mechanism.pulley.rows.push_back({alpha, theta});
  }
  mechanism.joint.theta_min = -0.3;
  mechanism.joint.theta_max = 0.2;
  EXPECT_EQ(failed(synthesise(mechanism, {.advice = false})).name, "law_grows");
}

TEST(Feasibility, WarnsOfTightBend) {
  Mechanism mechanism = testing::forearm();
  mechanism.tendon.bend_ratio = 25.0;
  const SynthesisResult result = synthesise(mechanism);
  ASSERT_TRUE(result.made());
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_THAT(result.warnings.back(), HasSubstr("D/d = 25"));
}

TEST(Feasibility, ListsAllConditions) {
  const SynthesisResult result = synthesise(testing::forearm());
  ASSERT_TRUE(result.made());
  EXPECT_EQ(result.conditions.size(), 17U);  // moment arms, and eight of each side
  for (const Condition& condition : result.conditions) EXPECT_TRUE(condition.message.empty()) << condition.name;
}

}  // namespace
}  // namespace fusee::profile
