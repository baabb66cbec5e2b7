#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "base/text.h"
#include "fusee/profile.h"
#include "support/mechanisms.h"

namespace fusee::profile {
namespace {

const Change* find(const std::vector<Change>& changes, const std::string& key) {
  const auto found =
      std::find_if(changes.begin(), changes.end(), [&](const Change& change) { return change.key == key; });
  return found == changes.end() ? nullptr : &*found;
}

TEST(NearestChanges, FindBothBorders) {
  const auto changes = nearest_changes(testing::forearm(), [](const Mechanism& m) { return m.pulley.r1 <= 12.3456; });
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].key, "pulley.r1_mm");
  EXPECT_EQ(changes[0].text, "r1 ≤ 12.3 mm");
  EXPECT_DOUBLE_EQ(changes[0].from, 16.0);
  EXPECT_FALSE(changes[0].until) << "every smaller r1 is accepted";
  const auto upward = nearest_changes(testing::forearm(), [](const Mechanism& m) { return m.pulley.EF >= 93.21; });
  EXPECT_EQ(upward.at(0).text, "EF ≥ 93.3 mm");
}

TEST(NearestChanges, PutTheNearestFirst) {
  const auto changes =
      nearest_changes(testing::forearm(), [](const Mechanism& m) { return m.pulley.r1 <= 8.0 || m.pulley.EF >= 84.0; });
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].key, "pulley.EF_mm");
  EXPECT_EQ(advice_sentence(changes), "make EF ≥ 84 mm, or r1 ≤ 8 mm");
}

// "or more" was advised for a torque of 1350, and 1500 was infeasible.
TEST(NearestChanges, NameBothEndsOfNarrowInterval) {
  const auto changes = nearest_changes(testing::forearm(),
                                       [](const Mechanism& m) { return m.pulley.r1 <= 12.3456 && m.pulley.r1 >= 11; });
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_NEAR(changes[0].to, 12.3, 1e-9);
  ASSERT_TRUE(changes[0].until);
  EXPECT_NEAR(*changes[0].until, 11.05, 0.051);
  const std::string least = rounded(*changes[0].until);
  EXPECT_EQ(changes[0].text, least + " mm ≤ r1 ≤ 12.3 mm");
  EXPECT_EQ(setting_words(changes[0]), "pulley.r1_mm = " + least + " to 12.3 (now 16)");
}

TEST(NearestChanges, KeepSymmetricRangeSymmetric) {
  const auto smaller = [](const Mechanism& m) { return m.joint.theta_max <= radians(25.05); };
  const auto symmetric = nearest_changes(testing::forearm(), smaller);
  const Change* half_range = find(symmetric, "joint.range_deg");
  ASSERT_NE(half_range, nullptr);
  EXPECT_EQ(half_range->text, "the range ±25°");
  const auto unsymmetric = nearest_changes(testing::unsymmetric(), smaller);
  ASSERT_NE(find(unsymmetric, "joint.range_deg[1]"), nullptr);
  EXPECT_EQ(find(unsymmetric, "joint.range_deg[0]"), nullptr);
}

TEST(NearestChanges, AreEmptyWithoutSolution) {
  EXPECT_TRUE(nearest_changes(testing::forearm(), [](const Mechanism&) { return false; }).empty());
  EXPECT_EQ(advice_sentence({}), "");
}

TEST(NearestChanges, SearchRequestedKeys) {
  Mechanism mechanism = testing::forearm();
  mechanism.body.bore_diameter = 30.0;
  const auto changes = nearest_changes(mechanism, [](const Mechanism& m) { return m.body.bore_diameter <= 22.22; },
                                       {"body.bore_diameter_mm"});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_NEAR(changes[0].to, 22.2, 1e-9);
}

/// A failed condition with this violation; none if it is not positive.
std::vector<Condition> fails_by(double gap) {
  if (gap <= 0) return {};
  Condition condition;
  condition.ok = false;
  condition.value = gap;
  return {condition};
}

TEST(Advice, LimitsEffort) {
  std::atomic<int> evaluations = 0;
  std::atomic<int> builds = 0;
  const FeasibilityOracle hopeless{[&](const Mechanism&) {
                                     ++evaluations;
                                     return fails_by(1.0);
                                   },
                                   [&](const Mechanism&) {
                                     ++builds;
                                     return true;
                                   }};
  EXPECT_TRUE(find_advice(testing::forearm(), hopeless).empty());
  EXPECT_LT(evaluations, 4000);  // the bounds of all numbers, before k_max_sweep_evaluations
  EXPECT_EQ(builds, 0);
  evaluations = 0;
  FeasibilityOracle expensive = hopeless;
  expensive.is_expensive = true;
  EXPECT_FALSE(find_advice(testing::forearm(), expensive).is_exhausted);
  EXPECT_LT(evaluations, 420);  // k_max_evaluations, and the unchanged mechanism
  const FeasibilityOracle unmakeable{[](const Mechanism& m) { return fails_by(m.pulley.r1 - 12 + m.pulley.EF - 80); },
                                     [&](const Mechanism&) {
                                       ++builds;
                                       return false;
                                     }};
  EXPECT_TRUE(find_advice(testing::forearm(), unmakeable).empty());
  EXPECT_GT(builds, 0);
  EXPECT_LE(builds, 4);  // k_max_builds
}

// Builds run concurrently, and the result must not depend on their durations.
TEST(Advice, IsIndependentOfBuildDurations) {
  const auto texts = [](bool first_is_slow) {
    const FeasibilityOracle judge{
        [](const Mechanism& m) { return fails_by(std::min(m.pulley.r1 - 12, 93 - m.pulley.EF)); },
        [first_is_slow](const Mechanism& m) {
          const bool is_first = m.pulley.r1 == 16;
          std::this_thread::sleep_for(std::chrono::milliseconds(is_first == first_is_slow ? 30 : 0));
          return true;
        }};
    return advice_sentence(find_advice(testing::forearm(), judge).alone);
  };
  EXPECT_EQ(texts(true), "make r1 ≤ 12 mm, or EF ≥ 93 mm");
  EXPECT_EQ(texts(true), texts(false));
}

TEST(Advice, TriesFurtherStepAfterFailedBuild) {
  const FeasibilityOracle judge{[](const Mechanism& m) { return fails_by(m.pulley.r1 - 12); },
                                [](const Mechanism& m) { return m.pulley.r1 <= 11.9; }};
  const Advice advice = find_advice(testing::forearm(), judge);
  ASSERT_FALSE(advice.alone.empty());
  EXPECT_EQ(advice.alone.front().key, "pulley.r1_mm");
  EXPECT_LE(advice.alone.front().to, 11.9);
}

TEST(Advice, SkipsHopelessChangesWhenExpensive) {
  const auto evaluations_of = [](bool is_expensive, double sufficient_r1, std::string& text) {
    std::atomic<int> evaluations = 0;
    const FeasibilityOracle judge{.obstacles =
                                      [&](const Mechanism& m) {
                                        ++evaluations;
                                        return fails_by(m.pulley.r1 - sufficient_r1);
                                      },
                                  .made = [](const Mechanism&) { return true; },
                                  .is_expensive = is_expensive};
    text = advice_sentence(find_advice(testing::forearm(), judge).alone);
    return evaluations.load();
  };
  std::string text, text_if_expensive;
  EXPECT_LT(3 * evaluations_of(true, -1, text_if_expensive), 2 * evaluations_of(false, -1, text));
  EXPECT_EQ(text_if_expensive, "");
  // A change that helps is evaluated at each step, so that its border is still found.
  evaluations_of(true, 8, text_if_expensive);
  evaluations_of(false, 8, text);
  EXPECT_EQ(text, "make r1 ≤ 8 mm");
  EXPECT_EQ(text_if_expensive, text);
}

TEST(Advice, RespectsBuildsLeft) {
  std::atomic<int> made = 0;
  FeasibilityOracle judge{
      .obstacles = [](const Mechanism& m) { return fails_by(std::min(m.pulley.r1 - 12, 93 - m.pulley.EF)); },
      .made =
          [&](const Mechanism&) {
            ++made;
            return true;
          }};
  EXPECT_EQ(find_advice(testing::forearm(), judge).alone.size(), 2U);
  EXPECT_EQ(find_advice(testing::forearm(), judge, {}, 1).alone.size(), 1U);
  EXPECT_TRUE(find_advice(testing::forearm(), judge, {}, 2).empty());
  judge.builds_left = [&made] { return 1 - made; };
  made = 0;
  EXPECT_EQ(find_advice(testing::forearm(), judge).alone.size(), 1U);
  EXPECT_EQ(made, 1);
}

// 5 mm was entered in place of 50 mm. The feasible window is narrow, and nine times the value away.
TEST(Advice, SearchesWholeRangeOfEachNumber) {
  Mechanism mechanism = testing::forearm();
  mechanism.guides.EB = 5.0;
  const FeasibilityOracle judge{[](const Mechanism& m) { return fails_by(std::abs(m.guides.EB - 50.0) - 9.0); },
                                [](const Mechanism&) { return true; }};
  const Advice advice = find_advice(mechanism, judge);
  ASSERT_EQ(advice.alone.size(), 1U);
  EXPECT_EQ(advice.alone.front().text, "EB ≥ 41 mm");
}

TEST(Advice, IsExhaustedOnlyAtBoundsOfAllNumbers) {
  double widest = 0;
  const FeasibilityOracle hopeless{[&widest](const Mechanism& m) {
    widest = std::max(widest, m.guides.EB);
    return fails_by(1.0);
  }};
  EXPECT_TRUE(find_advice(testing::forearm(), hopeless).is_exhausted);
  EXPECT_EQ(widest, 10000.0);
  const FeasibilityOracle unmakeable{[](const Mechanism& m) { return fails_by(m.pulley.r1 - 12); },
                                     [](const Mechanism&) { return false; }};
  EXPECT_FALSE(find_advice(testing::forearm(), unmakeable).is_exhausted);
}

TEST(Advice, AddsDrumOfTorqueLawBesideOthers) {
  const FeasibilityOracle judge{
      [](const Mechanism& m) {
        return fails_by(std::min({m.joint.R - 90, 93 - m.pulley.EF, m.joint.drum_radius - 12}));
      },
      [](const Mechanism&) { return true; }};
  Mechanism mechanism = testing::forearm();
  mechanism.joint.drum_radius = 25;
  EXPECT_EQ(find_advice(mechanism, judge).alone.size(), 2U);
  mechanism.pulley.law = Law::torque;
  mechanism.pulley.motor_torque = 1000;
  const Advice advice = find_advice(mechanism, judge);
  ASSERT_EQ(advice.alone.size(), 3U);
  EXPECT_EQ(advice.alone.back().text, "joint.drum_radius_mm ≤ 12 mm");
}

TEST(Advice, PutsTypedNumberFirst) {
  FeasibilityOracle judge{[](const Mechanism& m) { return fails_by(std::min(m.pulley.r1 - 15, 800 - m.guides.EB)); },
                          [](const Mechanism&) { return true; }};
  EXPECT_EQ(find_advice(testing::forearm(), judge).alone.front().key, "pulley.r1_mm");
  judge.first = {"guides.EB_mm"};
  const Advice advice = find_advice(testing::forearm(), judge);
  ASSERT_EQ(advice.alone.size(), 2U);
  EXPECT_EQ(advice.alone[0].text, "EB ≥ 800 mm");
  EXPECT_EQ(advice.alone[1].key, "pulley.r1_mm");
}

TEST(Advice, KeepsRangeWithinTable) {
  Mechanism mechanism = testing::forearm();
  mechanism.pulley.law = Law::table;
  for (int row = -4; row <= 4; ++row) mechanism.pulley.rows.push_back({radians(20.0 * row), radians(8.0 * row)});
  double widest = 0;
  const auto changes = nearest_changes(mechanism, [&](const Mechanism& m) {
    widest = std::max(widest, m.joint.theta_max);
    return false;
  });
  EXPECT_TRUE(changes.empty());
  EXPECT_NEAR(degrees(widest), 32.0, 1e-9);
}

}  // namespace
}  // namespace fusee::profile
