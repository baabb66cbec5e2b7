// Truths that are as they are said to be, and a judge who counts right.
#include "rig/judge.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "calibration/contract_effects.h"
#include "fusee/base/diagnostics.h"

namespace fusee::rig {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Calibration answer(CalibrationVerdict verdict, const std::vector<std::vector<std::string>>& groups) {
  Calibration found;
  found.verdict = verdict;
  for (const std::vector<std::string>& group : groups) {
    FoundEffect effect;
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

TEST(Judge, counts_what_was_found_and_what_was_not) {
  const Judgement one = judge(with({"tendon_stretch", "backlash"}),
                              answer(CalibrationVerdict::confounded, {{"creep", "tendon_stretch"}, {"sensor_lag"}}));
  EXPECT_EQ(one.named, 2u);
  EXPECT_EQ(one.held, 1u);
  EXPECT_EQ(one.alone, 0u);
  EXPECT_EQ(one.false_groups, 1u);
  EXPECT_EQ(one.wrong_alone, 1u);
  EXPECT_TRUE(one.outside.empty());
}

// The names in it are still false, and are counted as such by the older rate; it does not say that one of them is
// there.
TEST(Judge, a_group_that_may_be_nothing_with_a_name_blames_nobody) {
  const Judgement one = judge(with({"tendon_stretch", "backlash"}),
                              answer(CalibrationVerdict::confounded,
                                     {{"tendon_stretch", "unmodelled"}, {"sensor_lag", "unmodelled"}, {"backlash"}}));
  EXPECT_EQ(one.held, 2u);
  EXPECT_EQ(one.held_by_names, 1u);
  EXPECT_EQ(one.alone, 1u);
  EXPECT_EQ(one.false_groups, 1u);
  EXPECT_EQ(one.false_names, 0u);
  EXPECT_EQ(one.wrong_alone, 0u);
  const Rates found = rates({one});
  EXPECT_EQ(found.false_blame.part, 1u);
  EXPECT_EQ(found.false_names.part, 0u);
  EXPECT_EQ(found.held_by_names.part, 1u);
  EXPECT_EQ(found.alone.all, 2u);
}

// What the answer itself calls too small to show is counted apart: of the others it has to answer for each.
TEST(Judge, tells_what_should_have_shown_from_what_could_not) {
  Case made = with({"tendon_stretch", "backlash", "creep"});
  made.seen = {5, 5, 5};
  const double size = 5 * made.sensors.noise;
  Calibration found = answer(CalibrationVerdict::confounded, {{"creep"}});
  found.detectable = {{"tendon_stretch", 1.1 * size}, {"backlash", 0.9 * size}};
  const Judgement one = judge(made, found);
  EXPECT_EQ(one.named, 3u);
  EXPECT_EQ(one.held, 1u);
  EXPECT_EQ(one.beyond, 1u);
  EXPECT_EQ(judge(made, answer(CalibrationVerdict::not_testable, {})).beyond, 3u)
      << "what says nothing answers for all";
  EXPECT_THAT(matrix({one}), HasSubstr("would have shown | 50.0 % | 2 |"));
}

// A sensor's interpolation error of eight waves a turn was named motor_sensor_harmonic, in whose catalogue are four.
TEST(Judge, a_wave_without_a_name_is_not_given_one) {
  const Case made = make_case(random_truth(Kind::beside, "tuning", 31042), 31042, {Protocol::random, true});
  ASSERT_THAT(made.faults, ::testing::ElementsAre("joint_length", "encoder_interpolation"));
  const Judgement one = calibrate_case(made, std::filesystem::path(::testing::TempDir()) / "wave");
  EXPECT_EQ(one.held, 1u) << one.words;
  EXPECT_EQ(one.false_names, 0u) << one.words;
}

// A bench that cools down while a knot gives a little with every load was read as thermal_expansion, by 79 nats. Half
// a minute: FUSEE_LONG_TESTS=1.
TEST(Judge, a_knot_that_lets_go_with_the_loads_is_no_warmth) {
  if (std::getenv("FUSEE_LONG_TESTS") == nullptr) GTEST_SKIP() << "FUSEE_LONG_TESTS is not set";
  const Case made = make_case(random_truth(Kind::unknown, "unseen", 92053), 92053, {Protocol::random, true});
  ASSERT_EQ(made.truth, "creeping_knot");
  const Judgement one = calibrate_case(made, std::filesystem::path(::testing::TempDir()) / "knot");
  EXPECT_EQ(one.false_names, 0u) << one.words;
}

// A load cell that shows too little was named slack, alone and by 76 nats: a tendon goes slack where the load is larger
// than logged. Slack that is there keeps its name.
TEST(Judge, a_load_that_is_not_as_logged_is_no_slack) {
  const Case wrong = make_case(random_truth(Kind::unknown, "tuning", 51005), 51005, {Protocol::random, true});
  ASSERT_THAT(wrong.faults, ::testing::ElementsAre("wrong_load_cell"));
  const Judgement one = calibrate_case(wrong, std::filesystem::path(::testing::TempDir()) / "cell");
  EXPECT_EQ(one.false_names, 0u) << one.words;
  EXPECT_THAT(one.words, HasSubstr("times what was logged"));
  const Case slack = make_case(random_truth(Kind::beside, "tuning", 21022), 21022, {Protocol::random, true});
  ASSERT_THAT(slack.faults, ::testing::ElementsAre("slack", "encoder_interpolation"));
  const Judgement other = calibrate_case(slack, std::filesystem::path(::testing::TempDir()) / "slack");
  EXPECT_EQ(other.held_by_names, 1u) << other.words;
}

// A joint that had lost its pretension and little more was given 0.52 mm of slack (0.39 … 0.65) and 5 N of pretension,
// which together do what neither does.
TEST(Judge, slack_that_is_hardly_there_is_said_to_be_that) {
  const Case made = make_case(random_truth(Kind::two, "sealed", 131147), 131147, {Protocol::random, true});
  ASSERT_THAT(made.faults, ::testing::UnorderedElementsAre("slack", "gravity"));
  const Judgement one = calibrate_case(made, std::filesystem::path(::testing::TempDir()) / "hardly");
  EXPECT_EQ(one.held, 2u) << one.words;
  for (const Covered& number : one.numbers) EXPECT_TRUE(number.within) << number.name << one.words;
}

// An encoder off its axis, 7 times what should show, was left without any name: a curve explained it as well, and cost
// nothing. It cannot be told from its likes, and perhaps has no name; of all others there is no word.
TEST(Judge, a_smooth_error_of_place_is_said_with_its_likes_and_that_it_may_have_no_name) {
  const Case made = make_case(random_truth(Kind::two, "sealed", 131057), 131057, {Protocol::random, true});
  ASSERT_THAT(made.faults, ::testing::UnorderedElementsAre("guide_radius", "joint_sensor_eccentricity"));
  const Judgement one = calibrate_case(made, std::filesystem::path(::testing::TempDir()) / "smooth");
  EXPECT_EQ(one.held, 2u) << one.words;
  EXPECT_EQ(one.held_by_names, 0u) << one.words;
  EXPECT_EQ(one.false_groups, 0u) << one.words;
  for (const char* unlike : {"creep", "backlash", "tendon_stretch", "gravity"})
    EXPECT_THAT(one.words, Not(HasSubstr(unlike)));
}

TEST(Judge, kin_of_a_fault_without_a_name_is_no_false_blame) {
  const Judgement kin = judge(with({"grease"}), answer(CalibrationVerdict::explained, {{"sensor_lag"}}));
  EXPECT_FALSE(kin.outside.empty());
  EXPECT_EQ(kin.false_groups, 0u);
  EXPECT_EQ(judge(with({"grease"}), answer(CalibrationVerdict::explained, {{"backlash"}})).false_groups, 1u);
  EXPECT_THAT(matrix({kin}), HasSubstr(" grease is like sensor_lag.\n"));
}

TEST(Judge, rates_are_shares_of_what_they_say) {
  const std::vector<Judgement> all = {
      judge(with({}), answer(CalibrationVerdict::no_effect, {})),
      judge(with({}), answer(CalibrationVerdict::explained, {{"backlash"}})),
      judge(with({"backlash"}), answer(CalibrationVerdict::explained, {{"backlash"}})),
      judge(with({"backlash"}), answer(CalibrationVerdict::no_effect, {})),
      judge(with({"lump"}), answer(CalibrationVerdict::unexplained, {})),
      judge(with({"lump"}), answer(CalibrationVerdict::confounded, {{"profile_error", "gravity"}})),
  };
  const Rates found = rates(all);
  EXPECT_DOUBLE_EQ(found.miss.share(), 0.5);
  EXPECT_DOUBLE_EQ(found.false_blame.share(), 0.25);
  EXPECT_DOUBLE_EQ(found.false_blame_nothing.share(), 0.5);
  EXPECT_DOUBLE_EQ(found.false_blame_outside.share(), 0.5);
  EXPECT_DOUBLE_EQ(found.wrong_alone.share(), 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(found.unexplained_outside.share(), 0.5);
  EXPECT_DOUBLE_EQ(found.quiet.share(), 0.5);
  EXPECT_THAT(matrix(all), HasSubstr("| a truth | 6 |"));
  EXPECT_THAT(matrix(all), Not(HasSubstr("is like"))) << "a lump is like nothing";
}

TEST(Judge, a_cause_left_out_of_the_catalogue_has_no_name) {
  const Case lash = with({"backlash"});
  EXPECT_EQ(judge(lash, answer(CalibrationVerdict::explained, {{"slack"}})).false_groups, 1u);
  const Judgement kin = judge(lash, answer(CalibrationVerdict::explained, {{"slack"}}), {"backlash"});
  EXPECT_FALSE(kin.outside.empty());
  EXPECT_EQ(kin.named, 0u);
  EXPECT_EQ(kin.false_groups, 0u);
  EXPECT_EQ(judge(lash, answer(CalibrationVerdict::explained, {{"creep"}}), {"backlash"}).false_groups, 1u);
}

TEST(Judge, calibration_names_nothing_that_its_catalogue_lacks) {
  const Case lash = make_case({"backlash", {"backlash"}}, 1, {Protocol::full});
  const auto folder = std::filesystem::path(::testing::TempDir()) / "left_out";
  const auto said = [&](const std::vector<std::string>& without) {
    const std::string words = calibrate_case(lash, folder, without).words;
    return words.substr(words.find(':'));
  };
  EXPECT_THAT(said({}), HasSubstr("backlash"));
  EXPECT_THAT(said({"backlash"}), Not(HasSubstr("backlash")));
}

TEST(Judge, keeps_known_faults_beside_unknown_ones_apart) {
  const Rates found = rates({judge(with({"backlash", "lump"}), answer(CalibrationVerdict::unexplained, {{"backlash"}})),
                             judge(with({"creep", "lump"}), answer(CalibrationVerdict::unexplained, {}))});
  EXPECT_EQ(found.kept.part, 1u);
  EXPECT_EQ(found.kept.all, 2u);
  EXPECT_EQ(found.miss.all, 0u);
}

TEST(Judge, a_groove_unlike_the_file_may_be_named) {
  Case other = with({});
  const Calibration named = answer(CalibrationVerdict::explained, {{"groove_friction"}});
  EXPECT_EQ(judge(other, named).false_groups, 1u);
  other.hidden.groove_friction = 0.4;
  EXPECT_EQ(judge(other, named).false_groups, 0u);
}

TEST(Judge, holds_numbers_against_their_intervals) {
  Case lash = with({"backlash"});
  lash.hidden.backlash = radians(1.0);
  Calibration found = answer(CalibrationVerdict::explained, {{"backlash"}});
  found.effects[0].parameters = {{.name = "width_deg", .value = 1.1, .low = 0.9, .high = 1.3}};
  ASSERT_EQ(judge(lash, found).numbers.size(), 1u);
  EXPECT_TRUE(judge(lash, found).numbers[0].within);
  found.effects[0].parameters[0].low = 1.05;
  EXPECT_FALSE(judge(lash, found).numbers[0].within);
}

/// Wilson's interval as Newcombe (1998) prints it for his examples.
TEST(Judge, bounds_are_those_of_the_book) {
  EXPECT_NEAR(wilson({81, 263}).low, 0.2553, 5e-5);
  EXPECT_NEAR(wilson({81, 263}).high, 0.3662, 5e-5);
  EXPECT_NEAR(wilson({0, 20}).low, 0.0, 5e-5);
  EXPECT_NEAR(wilson({0, 20}).high, 0.1611, 5e-5);
  EXPECT_NEAR(wilson({1, 29}).low, 0.0061, 5e-5);
  EXPECT_NEAR(wilson({1, 29}).high, 0.1718, 5e-5);
}

TEST(Truths, name_every_effect_of_the_contract_and_some_that_nobody_named) {
  const std::vector<std::string> names = fault_names();
  for (const char* name : k_contract_effects) {
    EXPECT_THAT(names, Contains(name));
    EXPECT_TRUE(has_name(name));
  }
  for (const char* name :
       {"groove_friction", "joint_friction", "frame_compliance", "motor_sensor_harmonic", "joint_sensor_harmonic"})
    EXPECT_TRUE(has_name(name));
  EXPECT_GE(names_in("tuning").size(), 12u);
  for (const std::string& name : names_in("tuning")) EXPECT_FALSE(has_name(name));
  for (const std::string& name : names) {
    for (const std::string& kin : kin_of(name)) EXPECT_TRUE(has_name(kin)) << name << " is like " << kin;
  }
  EXPECT_THROW(has_name("backlesh"), InputError);
}

TEST(Truths, each_fault_is_well_seen_and_none_in_a_joint_as_declared) {
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
    EXPECT_EQ(made.hidden == Hidden{}, truth.faults.empty()) << truth.name;
  }
}

TEST(Truths, a_case_is_the_same_every_time) {
  const Truth truth{"backlash", {"backlash"}};
  EXPECT_EQ(files_of(make_case(truth, 3, {Protocol::single})), files_of(make_case(truth, 3, {Protocol::single})));
  EXPECT_NE(files_of(make_case(truth, 3, {Protocol::single})), files_of(make_case(truth, 4, {Protocol::single})));
}

}  // namespace
}  // namespace fusee::rig
