// The automatic hub follows the shaft and leaves space for the other features of its face.
#include "solid/hub.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

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

// Inradius of flange 2 for hub_choices(), mm.
constexpr double k_rim_radius = 18;

DeclaredMechanism profile_named(const std::string& name) {
  return read_mechanism(FUSEE_SOURCE_DIR "/profiles/" + name + ".toml").mechanism;
}

/// A finger's base joint with a drum, with this r1 and this diameter of the tendon. mm
DeclaredMechanism finger_of(double r1, double tendon) {
  DeclaredMechanism mechanism = profile_named("finger_mcp");
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

BodyLayout layout_of(const Mechanism& mechanism) { return resolve_layout(mechanism, profile::synthesise(mechanism)); }

std::vector<std::string> omitted_from(const BodyLayout& layout) {
  std::vector<std::string> features;
  for (const Omission& omission : layout.omissions) features.push_back(omission.feature);
  return features;
}

BodyLayout with_hub(Mechanism mechanism, double diameter) {
  mechanism.body.hub_diameter = diameter;
  return layout_of(mechanism);
}

// A nut would need a hub of 14.4 mm on a flange of 21 mm. The lists pin what the search finds: no finger lacks more.
TEST(Hub, CostsSmallPulleysFewFeatures) {
  struct Finger {
    double r1, tendon;
    std::vector<std::string> omitted;
  };
  const std::vector<Finger> fingers{{7.5, 0.4, {"hub", "set_screw"}},
                                    {7.5, 0.6, {"set_screw", "home_mark", "label_P2"}},
                                    {8, 0.4, {"nut", "spare_tie_off_P2", "tail_slot_P2", "label_P2"}},
                                    {8, 0.6, {"set_screw", "home_mark"}},
                                    {9, 0.4, {"nut", "home_mark"}},
                                    {9, 0.6, {"set_screw"}},
                                    {10, 0.4, {"nut", "home_mark"}},
                                    {10, 0.6, {"nut"}}};
  for (const Finger& finger : fingers) {
    SCOPED_TRACE(::testing::Message() << "r1 " << finger.r1 << ", tendon " << finger.tendon);
    const Pulley pulley = built(finger_of(finger.r1, finger.tendon));
    ASSERT_TRUE(pulley.made()) << pulley.brief();
    EXPECT_TRUE(all_ok(pulley.mesh_checks));
    EXPECT_EQ(omitted_from(pulley.layout), finger.omitted);
  }
}

TEST(Hub, KeepsNutWhereNothingIsLost) {
  const Pulley pulley = built(profile_named("forearm"));
  EXPECT_THAT(omitted_from(pulley.layout), ::testing::IsEmpty());
  EXPECT_EQ(pulley.layout.set_screw.thread, "M3");
  EXPECT_TRUE(pulley.layout.set_screw.nut_trap);
}

TEST(Hub, AutomaticOmitsLessThanWideOne) {
  const Mechanism mechanism = finger_of(9.0, 0.6);
  const BodyLayout automatic = layout_of(mechanism), wide = with_hub(mechanism, 14.4);
  EXPECT_GT(wide.omissions.size(), automatic.omissions.size());
  EXPECT_LT(automatic.hub_radius, wide.hub_radius);
}

TEST(Hub, KeepsRequestedDiameter) {
  Mechanism mechanism = finger_of(9.0, 0.6);
  mechanism.body.hub_diameter = 14.4;
  EXPECT_DOUBLE_EQ(resolve_layout(mechanism, profile::synthesise(mechanism)).hub_radius, 7.2);
}

TEST(HubChoices, FallInSizeAndEndWithoutHub) {
  const Mechanism mechanism = plain_mechanism();
  const BodyLayout layout = resolve_layout(mechanism, pulley_of(circle(20), circle(18)));
  const std::vector<HubChoice> choices = hub_choices(layout, mechanism, k_rim_radius);
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
  for (const HubChoice& choice : hub_choices(layout, mechanism, k_rim_radius)) {
    EXPECT_THAT(choice.set_screw.thread, ::testing::AnyOf("M2", ""));
  }
}

TEST(HubChoices, KeepWhatTheFileRequests) {
  Mechanism mechanism = plain_mechanism();
  const BodyLayout layout = resolve_layout(mechanism, pulley_of(circle(20), circle(18)));
  mechanism.body.hub_diameter = 10;
  for (const HubChoice& choice : hub_choices(layout, mechanism, k_rim_radius)) EXPECT_EQ(choice.radius, 5);
  mechanism.body.hub_height = 0;
  ASSERT_EQ(hub_choices(layout, mechanism, k_rim_radius).size(), 1U);
  EXPECT_EQ(hub_choices(layout, mechanism, k_rim_radius).front().radius, 0);
}

}  // namespace
}  // namespace fusee::solid
