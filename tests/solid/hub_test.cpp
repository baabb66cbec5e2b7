// The automatic hub follows the shaft and leaves space for the other features of its face.
#include "solid/hub.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "fusee/mechanism_file.h"
#include "fusee/profile.h"
#include "fusee/solid.h"
#include "support/mechanisms.h"
#include "support/shapes.h"

namespace fusee::solid {
namespace {

using testing::circle;
using testing::plain_mechanism;
using testing::pulley_of;

/// A finger's base joint with a drum, as its length, r1 and tendon.
DeclaredMechanism finger_of(double r1, double tendon) {
  DeclaredMechanism mechanism = read_mechanism(std::string(FUSEE_SOURCE_DIR) + "/profiles/finger_mcp.toml").mechanism;
  mechanism.joint.R = 45;
  mechanism.joint.theta_min = 0;
  mechanism.joint.theta_max = radians(80);
  mechanism.pulley.r1 = r1;
  mechanism.tendon.diameter = tendon;
  return mechanism;
}

Pulley built(const Mechanism& mechanism) {
  const profile::SynthesisResult synthesis = profile::synthesise(mechanism);
  EXPECT_TRUE(synthesis.made());
  return make_pulley(mechanism, synthesis);
}

std::vector<std::string> omitted_from(const Pulley& pulley) {
  std::vector<std::string> features;
  for (const Omission& omission : pulley.layout.omissions) features.push_back(omission.feature);
  return features;
}

// A nut would need a hub of 14.4 mm on a flange of 21 mm. A thread in the hub holds the shaft as well.
TEST(Hub, LeavesSpaceOnSmallPulleys) {
  for (const double r1 : {7.5, 8.0, 9.0, 10.0}) {
    for (const double tendon : {0.4, 0.6}) {
      SCOPED_TRACE(::testing::Message() << "r1 " << r1 << ", tendon " << tendon);
      const Pulley pulley = built(finger_of(r1, tendon));
      ASSERT_TRUE(pulley.made()) << pulley.brief();
      EXPECT_THAT(omitted_from(pulley), ::testing::IsSubsetOf({"nut"}));
      EXPECT_TRUE(pulley.layout.set_screw.present);
      EXPECT_TRUE(pulley.has_home_mark());
      EXPECT_TRUE(all_ok(pulley.mesh_checks));
    }
  }
}

TEST(Hub, KeepsNutWhereNothingIsLost) {
  const Pulley pulley = built(testing::forearm());
  EXPECT_THAT(omitted_from(pulley), ::testing::IsEmpty());
  EXPECT_EQ(pulley.layout.set_screw.thread, "M3");
  EXPECT_TRUE(pulley.layout.set_screw.nut_trap);
}

// No larger hub of the list keeps as many features, and a requested diameter is kept whatever it costs.
TEST(Hub, IsTheLargestThatKeepsTheFeatures) {
  Mechanism mechanism = finger_of(9.0, 0.6);
  const profile::SynthesisResult synthesis = profile::synthesise(mechanism);
  const BodyLayout automatic = resolve_layout(mechanism, synthesis);
  mechanism.body.hub_diameter = 14.4;
  const BodyLayout wide = resolve_layout(mechanism, synthesis);
  EXPECT_DOUBLE_EQ(wide.hub_radius, 7.2);
  EXPECT_GT(wide.omissions.size(), automatic.omissions.size());
  EXPECT_LT(automatic.hub_radius, wide.hub_radius);
  EXPECT_GT(automatic.hub_radius, least_hub_radius(automatic));
}

TEST(HubChoices, FallInSizeAndEndWithoutHub) {
  const Mechanism mechanism = plain_mechanism();
  const BodyLayout layout = resolve_layout(mechanism, pulley_of(circle(20), circle(18)));
  const std::vector<HubChoice> choices = hub_choices(layout, mechanism, 18);
  ASSERT_GT(choices.size(), 4U);
  EXPECT_TRUE(std::is_sorted(choices.begin(), choices.end(),
                             [](const HubChoice& a, const HubChoice& b) { return a.radius > b.radius; }));
  EXPECT_TRUE(choices.front().set_screw.nut_trap);
  EXPECT_FALSE(choices[choices.size() - 2].set_screw.present);
  EXPECT_EQ(choices.back().radius, 0);
}

TEST(HubChoices, ScrewIsNoWiderThanShaft) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.bore_diameter = 2.0;
  const BodyLayout layout = resolve_layout(mechanism, pulley_of(circle(20), circle(18)));
  for (const HubChoice& choice : hub_choices(layout, mechanism, 18)) {
    EXPECT_THAT(choice.set_screw.thread, ::testing::AnyOf("M2", ""));
  }
}

TEST(HubChoices, KeepWhatTheFileRequests) {
  Mechanism mechanism = plain_mechanism();
  const BodyLayout layout = resolve_layout(mechanism, pulley_of(circle(20), circle(18)));
  mechanism.body.hub_diameter = 10;
  for (const HubChoice& choice : hub_choices(layout, mechanism, 18)) EXPECT_EQ(choice.radius, 5);
  mechanism.body.hub_height = 0;
  ASSERT_EQ(hub_choices(layout, mechanism, 18).size(), 1U);
  EXPECT_EQ(hub_choices(layout, mechanism, 18).front().radius, 0);
}

}  // namespace
}  // namespace fusee::solid
