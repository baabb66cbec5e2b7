#include "fusee/profile/advice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/mechanisms.h"

namespace fusee {
namespace {

const Change* find(const std::vector<Change>& changes, const std::string& key) {
  const auto found = std::find_if(changes.begin(), changes.end(), [&](const Change& change) { return change.key == key; });
  return found == changes.end() ? nullptr : &*found;
}

TEST(NearestChanges, FindBordersOnBothSides) {
  const auto changes = nearest_changes(testing::forearm(), [](const Mechanism& m) { return m.pulley.r1 <= 12.3456; });
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].key, "pulley.r1_mm");
  EXPECT_EQ(changes[0].text, "r1 ≤ 12.3 mm");
  EXPECT_DOUBLE_EQ(changes[0].from, 16.0);
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

TEST(NearestChanges, TurnASymmetricRangeAsOneAndAnUnsymmetricOneByItsEnds) {
  const auto smaller = [](const Mechanism& m) { return m.joint.theta_max <= radians(25.05); };
  const Change* both = nullptr;
  const auto symmetric = nearest_changes(testing::forearm(), smaller);
  ASSERT_NE(both = find(symmetric, "joint.range_deg"), nullptr);
  EXPECT_EQ(both->text, "the range ±25°");
  const auto unsymmetric = nearest_changes(testing::unsymmetric(), smaller);
  ASSERT_NE(find(unsymmetric, "joint.range_deg[1]"), nullptr);
  EXPECT_EQ(find(unsymmetric, "joint.range_deg[0]"), nullptr);
}

TEST(NearestChanges, AreNoneWhereNothingHelps) {
  EXPECT_TRUE(nearest_changes(testing::forearm(), [](const Mechanism&) { return false; }).empty());
  EXPECT_EQ(advice_sentence({}), "");
}

TEST(NearestChanges, LookAtMoreKeysOnRequest) {
  Mechanism mechanism = testing::forearm();
  mechanism.body.bore_diameter = 30.0;
  const auto changes =
      nearest_changes(mechanism, [](const Mechanism& m) { return m.body.bore_diameter <= 22.22; }, {"body.bore_diameter_mm"});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_NEAR(changes[0].to, 22.2, 1e-9);
}

}  // namespace
}  // namespace fusee
