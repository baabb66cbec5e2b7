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

/// Features omitted with a hub of 14.4 mm, which holds a nut, and with the automatic one.
struct Omitted {
  std::size_t wide = 0, automatic = 0;
};

Omitted omitted_from(Mechanism mechanism) {
  const profile::SynthesisResult synthesis = profile::synthesise(mechanism);
  Omitted omitted;
  omitted.automatic = resolve_layout(mechanism, synthesis).omissions.size();
  mechanism.body.hub_diameter = 14.4;
  omitted.wide = resolve_layout(mechanism, synthesis).omissions.size();
  return omitted;
}

TEST(Hub, CostsSmallPulleysFewerFeatures) {
  for (const double r1 : {7.5, 8.0, 9.0, 10.0}) {
    for (const double tendon : {0.4, 0.6}) {
      SCOPED_TRACE(::testing::Message() << "r1 " << r1 << ", tendon " << tendon);
      const Mechanism mechanism = finger_of(r1, tendon);
      const Omitted omitted = omitted_from(mechanism);
      EXPECT_LE(omitted.automatic, omitted.wide);
      const Pulley pulley = built(mechanism);
      ASSERT_TRUE(pulley.made()) << pulley.brief();
      EXPECT_TRUE(all_ok(pulley.mesh_checks));
    }
  }
  const Omitted usual = omitted_from(finger_of(9.0, 0.6));
  EXPECT_LT(usual.automatic, usual.wide);
}

TEST(Hub, KeepsRequestedDiameter) {
  Mechanism mechanism = finger_of(9.0, 0.6);
  mechanism.body.hub_diameter = 14.4;
  EXPECT_DOUBLE_EQ(resolve_layout(mechanism, profile::synthesise(mechanism)).hub_radius, 7.2);
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
