// Cases have the faults of their truth, and judgements count correctly.
#include "rig/judge.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "calibration/contract_effects.h"
#include "fusee/base.h"

namespace fusee::rig {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

calibration::Calibration answer(calibration::CalibrationVerdict verdict,
                                const std::vector<std::vector<std::string>>& groups) {
  calibration::Calibration found;
  found.verdict = verdict;
  for (const std::vector<std::string>& group : groups) {
    calibration::FoundEffect effect;
    effect.name = group.front();
    effect.group = group;
    found.effects.push_back(effect);
  }
  return found;
}

Case with(const std::vector<std::string>& faults) {
  Case made;
  made.truth = "a truth";
  made.faults = faults;
  return made;
}

TEST(Judge, CountsFoundAndMissed) {
  const Judgement one =
      judge(with({"tendon_stretch", "backlash"}),
            answer(calibration::CalibrationVerdict::confounded, {{"creep", "tendon_stretch"}, {"sensor_lag"}}));
  EXPECT_EQ(one.named, 2u);
  EXPECT_EQ(one.held, 1u);
  EXPECT_EQ(one.alone, 0u);
  EXPECT_EQ(one.false_groups, 1u);
  EXPECT_EQ(one.wrong_alone, 1u);
  EXPECT_TRUE(one.outside.empty());
}

// Such a group counts as false group, but not as false positive.
TEST(Judge, UnmodelledGroupIsNoFalsePositive) {
  const Judgement one = judge(with({"tendon_stretch", "backlash"}),
                              answer(calibration::CalibrationVerdict::confounded,
                                     {{"tendon_stretch", "unmodelled"}, {"sensor_lag", "unmodelled"}, {"backlash"}}));
  EXPECT_EQ(one.held, 2u);
  EXPECT_EQ(one.held_by_names, 1u);
  EXPECT_EQ(one.alone, 1u);
  EXPECT_EQ(one.false_groups, 1u);
  EXPECT_EQ(one.false_names, 0u);
  EXPECT_EQ(one.wrong_alone, 0u);
  const Rates found = rates({one});
  EXPECT_EQ(found.false_groups.part, 1u);
  EXPECT_EQ(found.false_names.part, 0u);
  EXPECT_EQ(found.held_by_names.part, 1u);
  EXPECT_EQ(found.alone.all, 2u);
}

// Missed faults smaller than the reported detectable size are counted separately.
TEST(Judge, CountsMissesBelowDetectable) {
  Case made = with({"tendon_stretch", "backlash", "creep"});
  made.seen = {5, 5, 5};
  const double size = 5 * made.sensors.noise;
  calibration::Calibration found = answer(calibration::CalibrationVerdict::confounded, {{"creep"}});
  found.detectable = {{"tendon_stretch", 1.1 * size}, {"backlash", 0.9 * size}};
  const Judgement one = judge(made, found);
  EXPECT_EQ(one.named, 3u);
  EXPECT_EQ(one.held, 1u);
  EXPECT_EQ(one.beyond, 1u);
  EXPECT_EQ(judge(made, answer(calibration::CalibrationVerdict::not_testable, {})).beyond, 3u)
      << "without detectable sizes all count";
  EXPECT_THAT(matrix({one}), HasSubstr("smaller than `detectable` | 50.0 % | 2 |"));
}

TEST(Judge, KinIsNoFalsePositive) {
  const Judgement kin = judge(with({"grease"}), answer(calibration::CalibrationVerdict::explained, {{"sensor_lag"}}));
  EXPECT_FALSE(kin.outside.empty());
  EXPECT_EQ(kin.false_groups, 0u);
  EXPECT_EQ(judge(with({"grease"}), answer(calibration::CalibrationVerdict::explained, {{"backlash"}})).false_groups,
            1u);
  EXPECT_THAT(matrix({kin}), HasSubstr(" grease is like sensor_lag.\n"));
}

TEST(Judge, RatesAreShares) {
  const std::vector<Judgement> all = {
      judge(with({}), answer(calibration::CalibrationVerdict::no_effect, {})),
      judge(with({}), answer(calibration::CalibrationVerdict::explained, {{"backlash"}})),
      judge(with({"backlash"}), answer(calibration::CalibrationVerdict::explained, {{"backlash"}})),
      judge(with({"backlash"}), answer(calibration::CalibrationVerdict::no_effect, {})),
      judge(with({"lump"}), answer(calibration::CalibrationVerdict::unexplained, {})),
      judge(with({"lump"}), answer(calibration::CalibrationVerdict::confounded, {{"profile_error", "gravity"}})),
  };
  const Rates found = rates(all);
  EXPECT_DOUBLE_EQ(found.miss.share(), 0.5);
  EXPECT_DOUBLE_EQ(found.false_groups.share(), 0.25);
  EXPECT_DOUBLE_EQ(found.false_groups_nothing.share(), 0.5);
  EXPECT_DOUBLE_EQ(found.false_groups_outside.share(), 0.5);
  EXPECT_DOUBLE_EQ(found.wrong_alone.share(), 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(found.unexplained_outside.share(), 0.5);
  EXPECT_DOUBLE_EQ(found.quiet.share(), 0.5);
  EXPECT_THAT(matrix(all), HasSubstr("| a truth | 6 |"));
  EXPECT_THAT(matrix(all), Not(HasSubstr("is like"))) << "a lump has no kin";
}

TEST(Judge, LeftOutEffectIsUnmodelled) {
  const Case lash = with({"backlash"});
  EXPECT_EQ(judge(lash, answer(calibration::CalibrationVerdict::explained, {{"slack"}})).false_groups, 1u);
  const Judgement kin = judge(lash, answer(calibration::CalibrationVerdict::explained, {{"slack"}}), {"backlash"});
  EXPECT_FALSE(kin.outside.empty());
  EXPECT_EQ(kin.named, 0u);
  EXPECT_EQ(kin.false_groups, 0u);
  EXPECT_EQ(judge(lash, answer(calibration::CalibrationVerdict::explained, {{"creep"}}), {"backlash"}).false_groups,
            1u);
}

TEST(Judge, LeftOutEffectIsNeverReported) {
  const Case lash = make_case({"backlash", {"backlash"}}, 1, {Protocol::full});
  const auto folder = std::filesystem::path(::testing::TempDir()) / "left_out";
  const auto reported = [&](const std::vector<std::string>& without) {
    const std::string words = calibrate_case(lash, folder, without).judgement.words;
    return words.substr(words.find(':'));
  };
  EXPECT_THAT(reported({}), HasSubstr("backlash"));
  EXPECT_THAT(reported({"backlash"}), Not(HasSubstr("backlash")));
}

TEST(Judge, CountsEffectsBesideUnmodelled) {
  const Rates found =
      rates({judge(with({"backlash", "lump"}), answer(calibration::CalibrationVerdict::unexplained, {{"backlash"}})),
             judge(with({"creep", "lump"}), answer(calibration::CalibrationVerdict::unexplained, {}))});
  EXPECT_EQ(found.kept.part, 1u);
  EXPECT_EQ(found.kept.all, 2u);
  EXPECT_EQ(found.miss.all, 0u);
}

TEST(Judge, GrooveFrictionMayBeReported) {
  Case other = with({});
  const calibration::Calibration named = answer(calibration::CalibrationVerdict::explained, {{"groove_friction"}});
  EXPECT_EQ(judge(other, named).false_groups, 1u);
  other.hidden.groove_friction = 0.4;
  EXPECT_EQ(judge(other, named).false_groups, 0u);
}

TEST(Judge, ComparesNumbersWithIntervals) {
  Case lash = with({"backlash"});
  lash.hidden.backlash = radians(1.0);
  calibration::Calibration found = answer(calibration::CalibrationVerdict::explained, {{"backlash"}});
  found.effects[0].parameters = {
      {.name = "width_deg", .value = 1.1, .low = 0.9, .high = 1.3, .low_if_only = 1.05, .high_if_only = 1.15}};
  const Judgement judged = judge(lash, found);
  ASSERT_EQ(judged.numbers.size(), 1u);
  EXPECT_NEAR(judged.numbers[0].overall.in_half_widths, -0.5, 1e-12);
  EXPECT_NEAR(judged.numbers[0].if_only.in_half_widths, -2, 1e-12);
  const Rates counted = rates({judged});
  EXPECT_EQ(counted.covered.part, 1u);
  EXPECT_EQ(counted.covered_if_only.part, 0u);
  EXPECT_EQ(counted.covered_if_only.all, 1u);
}

/// Wilson's interval as Newcombe (1998) prints it for his examples.
TEST(Judge, ComputesWilsonBounds) {
  EXPECT_NEAR(wilson({81, 263}).low, 0.2553, 5e-5);
  EXPECT_NEAR(wilson({81, 263}).high, 0.3662, 5e-5);
  EXPECT_NEAR(wilson({0, 20}).low, 0.0, 5e-5);
  EXPECT_NEAR(wilson({0, 20}).high, 0.1611, 5e-5);
  EXPECT_NEAR(wilson({1, 29}).low, 0.0061, 5e-5);
  EXPECT_NEAR(wilson({1, 29}).high, 0.1718, 5e-5);
}

TEST(Truths, NameEveryEffect) {
  for (const char* name : calibration::k_contract_effects) EXPECT_TRUE(has_name(name));
  for (const char* name :
       {"groove_friction", "joint_friction", "frame_compliance", "motor_sensor_harmonic", "joint_sensor_harmonic"})
    EXPECT_TRUE(has_name(name));
  EXPECT_GE(names_in("tuning").size(), 12u);
  for (const std::string& name : names_in("tuning")) EXPECT_FALSE(has_name(name));
  EXPECT_THROW(has_name("backlesh"), InputError);
  EXPECT_THROW(random_truth(Kind::unknown, "unknown_split", 1), InputError);
}

TEST(Truths, FaultsAreWellSeen) {
  for (const char* name :
       {"nothing", "backlash", "slack", "sensor_lag", "tendon_slip", "hardening_tendon", "bedding_in"}) {
    const std::vector<Truth> all = all_truths();
    const Truth truth = *std::find_if(all.begin(), all.end(), [&](const Truth& one) { return one.name == name; });
    const Case made = make_case(truth, 1);
    ASSERT_EQ(made.seen.size(), truth.faults.size());
    for (const double times : made.seen) {
      EXPECT_GT(times, 2.5) << truth.name;
      EXPECT_LT(times, 20.0) << truth.name;
    }
    EXPECT_EQ(made.hidden == HiddenFaults{}, truth.faults.empty()) << truth.name;
  }
}

TEST(Truths, CaseIsRepeatable) {
  const Truth truth{"backlash", {"backlash"}};
  EXPECT_EQ(files_of(make_case(truth, 3, {Protocol::single})), files_of(make_case(truth, 3, {Protocol::single})));
  EXPECT_NE(files_of(make_case(truth, 3, {Protocol::single})), files_of(make_case(truth, 4, {Protocol::single})));
}

}  // namespace
}  // namespace fusee::rig
