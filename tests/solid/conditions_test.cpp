// Impossible parts are refused with the number to change, and with that number they are made.
#include <gtest/gtest.h>

#include "fusee/solid/pulley.h"
#include "support/shapes.h"

namespace fusee {
namespace {

using testing::circle;
using testing::plain_mechanism;
using testing::pulley_of;

const SynthesisResult& round_pulley() {
  static const SynthesisResult shape = pulley_of(circle(20), circle(18));
  return shape;
}

const Condition& condition_named(const Pulley& pulley, const std::string& name) {
  for (const Condition& condition : pulley.conditions) {
    if (condition.name == name) return condition;
  }
  throw std::out_of_range("no condition named " + name);
}

// The number after `key` and its sign in the message of a condition that failed.
double advised(const Pulley& pulley, const std::string& condition, const std::string& key) {
  EXPECT_FALSE(pulley.made());
  const std::string& message = condition_named(pulley, condition).message;
  const std::size_t at = message.find(key);
  EXPECT_NE(at, std::string::npos) << message;
  return std::stod(message.substr(message.find_first_of("0123456789", at + key.size())));
}

TEST(Conditions, AllHoldForTheDefaultBody) {
  const Pulley pulley = make_pulley(plain_mechanism(), round_pulley());
  for (const Condition& condition : pulley.conditions) {
    EXPECT_TRUE(condition.ok) << condition.message;
    EXPECT_EQ(condition.message.find("make "), std::string::npos) << "advice without need: " << condition.message;
  }
}

TEST(Conditions, BoreLargerThanTheFloor) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.hub_height = 0;
  mechanism.body.bore_diameter = 40;
  const Pulley pulley = make_pulley(mechanism, round_pulley());
  EXPECT_LT(condition_named(pulley, "bore_wall_P2").value, 0);
  mechanism.body.bore_diameter = advised(pulley, "bore_wall_P2", "body.bore_diameter_mm");
  const Pulley smaller = make_pulley(mechanism, round_pulley());
  EXPECT_TRUE(condition_named(smaller, "bore_wall_P2").ok);
  mechanism.body.bore_diameter += 0.2;
  EXPECT_FALSE(condition_named(make_pulley(mechanism, round_pulley()), "bore_wall_P2").ok);
  // What then still lacks is room for the tie-offs: the next advice leads to a part.
  mechanism.body.bore_diameter = advised(smaller, "anchor_P2", "body.bore_diameter_mm");
  EXPECT_TRUE(make_pulley(mechanism, round_pulley()).made());
}

TEST(Conditions, WallThickerThanThereIsRoomFor) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.bore_diameter = 5;
  mechanism.body.min_wall = 8;
  const Pulley pulley = make_pulley(mechanism, round_pulley());
  mechanism.body.min_wall =
      std::min(advised(pulley, "anchor_P1", "body.min_wall_mm"), advised(pulley, "anchor_P2", "body.min_wall_mm"));
  const Pulley thinner = make_pulley(mechanism, round_pulley());
  EXPECT_TRUE(thinner.made()) << thinner.brief();
}

TEST(Conditions, HubOverTheFlangeAndHubWithoutWall) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.set_screw = "none";
  mechanism.body.hub_diameter = 60;
  const Pulley wide = make_pulley(mechanism, round_pulley());
  mechanism.body.hub_diameter = advised(wide, "hub_on_flange", "body.hub_diameter_mm");
  EXPECT_TRUE(condition_named(make_pulley(mechanism, round_pulley()), "hub_on_flange").ok);
  mechanism.body.hub_diameter = 6;
  const Pulley thin = make_pulley(mechanism, round_pulley());
  mechanism.body.hub_diameter = advised(thin, "hub_wall", "body.hub_diameter_mm");
  EXPECT_TRUE(make_pulley(mechanism, round_pulley()).made());
}

TEST(Conditions, SetScrewThatIsAskedForMustFit) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.set_screw = "M4";
  mechanism.body.hub_height = 4;
  const Pulley low = make_pulley(mechanism, round_pulley());
  mechanism.body.hub_height = advised(low, "set_screw_height", "body.hub_height_mm");
  const Pulley high = make_pulley(mechanism, round_pulley());
  EXPECT_TRUE(high.made()) << high.brief();
  EXPECT_TRUE(high.layout.set_screw.present);
}

TEST(Conditions, PinInTheFlanges) {
  Mechanism mechanism = plain_mechanism();
  mechanism.guides.ED = 15;
  mechanism.pulley.EF = 15;
  const Pulley pulley = make_pulley(mechanism, round_pulley());
  EXPECT_FALSE(condition_named(pulley, "pin_clear_D").ok);
  mechanism.pulley.EF = advised(pulley, "pin_clear_D", "pulley.EF_mm");
  EXPECT_TRUE(condition_named(make_pulley(mechanism, round_pulley()), "pin_clear_D").ok);
}

TEST(Conditions, GrooveChamferAndChannel) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.groove_depth = 0.5;
  mechanism.body.flange_thickness = 0.5;
  mechanism.body.anchor_hole = 0.8;
  const Pulley pulley = make_pulley(mechanism, round_pulley());
  mechanism.body.groove_depth = advised(pulley, "groove_depth", "body.groove_depth_mm");
  mechanism.body.flange_thickness = advised(pulley, "flange_thickness", "body.flange_thickness_mm");
  mechanism.body.anchor_hole = advised(pulley, "channel_width", "body.anchor_hole_mm");
  const Pulley mended = make_pulley(mechanism, round_pulley());
  EXPECT_TRUE(mended.made()) << mended.brief();
}

TEST(Conditions, KnotPocketThatIsAskedForMustFit) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.knot_pocket = 25;
  const Pulley pulley = make_pulley(mechanism, round_pulley());
  EXPECT_FALSE(condition_named(pulley, "anchor_P2").ok);
  EXPECT_NE(condition_named(pulley, "anchor_P2").message.find("body.knot_pocket_mm"), std::string::npos);
}

// What is automatic is made to fit, with a note, before anything is refused.
TEST(Conditions, AutomaticSizesShrinkWithANote) {
  Mechanism mechanism = plain_mechanism();
  mechanism.tendon.diameter = 0.4;
  const SynthesisResult small = pulley_of(circle(6), circle(5.5));
  const Pulley pulley = make_pulley(mechanism, small);
  ASSERT_TRUE(pulley.made()) << pulley.brief();
  EXPECT_FALSE(pulley.layout.notes.empty());
  EXPECT_FALSE(pulley.layout.set_screw.present);
}

TEST(Conditions, LayoutAgreesWithThePulley) {
  const Pulley pulley = make_pulley(plain_mechanism(), round_pulley());
  const BodyLayout layout = resolve_layout(plain_mechanism(), round_pulley());
  const BodyLayout axial = axial_layout(plain_mechanism());
  EXPECT_EQ(layout.z_hub, pulley.layout.z_hub);
  EXPECT_EQ(layout.pocket_radius, pulley.layout.pocket_radius);
  EXPECT_EQ(axial.z_p1, pulley.layout.z_p1);
  EXPECT_EQ(axial.z_p2, pulley.layout.z_p2);
}

}  // namespace
}  // namespace fusee
