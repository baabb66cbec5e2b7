#include <gmock/gmock.h>

#include "fusee/mechanism_file.h"
#include "mechanism/mechanism_text.h"

namespace fusee {
namespace {

TEST(Edit, KeepsCommentsOrderAndLayout) {
  const std::string text =
      "# Größe µ: a comment\nschema = 1\n\n[guides]   # first\n  EB_mm=50 # B\n\tED_mm = 5e1\nOE_mm =   -40.0   # "
      "minus – a dash\n"
      "[joint]\nrange_deg = [ -30.0 , 30.0 ] # both\nlength_mm = 100.0 # R\n[pulley]\nEF_mm = 80\nr1_mm = "
      "16\n[tendon]\ndiameter_mm = 1\n";
  const std::string edited = edit_values(text, {{"joint.length_mm", 123.25},
                                                {"guides.ED_mm", 61.5},
                                                {"guides.OE_mm", 3.0},
                                                {"joint.range_deg[1]", 25.0},
                                                {"guides.EB_mm", 61.5}});
  EXPECT_EQ(edited,
            "# Größe µ: a comment\nschema = 1\n\n[guides]   # first\n  EB_mm=61.5 # B\n\tED_mm = 61.5\nOE_mm =   3   # "
            "minus – a dash\n"
            "[joint]\nrange_deg = [ -30.0 , 25 ] # both\nlength_mm = 123.25 # R\n[pulley]\nEF_mm = 80\nr1_mm = "
            "16\n[tendon]\ndiameter_mm = 1\n");
}

TEST(Edit, WritesOmittedKeys) {
  const std::string edited =
      edit_values(k_good_file, {{"guides.friction", 0.2}, {"body.min_wall_mm", 1.5}, {"body.mark_depth_mm", 0.5}});
  EXPECT_EQ(edited, replaced(k_good_file, "[guides]\n", "[guides]\nfriction = 0.2\n") +
                        "\n[body]\nmin_wall_mm = 1.5\nmark_depth_mm = 0.5\n");
  const DeclaredMechanism mechanism = parse_mechanism(edited, "f.toml");
  EXPECT_EQ(mechanism.guides.mu, 0.2);
  EXPECT_EQ(mechanism.body.min_wall, 1.5);
}

TEST(Edit, WritesOmittedKeysIntoBraces) {
  for (const char* braces : {"load = {}\n", "load = { mass_kg = 0.4 }\n"}) {
    const DeclaredMechanism mechanism = parse_mechanism(
        edit_values(braces + k_good_file, {{"load.tip_force_N", 2}, {"load.torque_Nmm", 3}, {"load.lever_mm", 5}}),
        "f.toml");
    EXPECT_EQ(mechanism.load.tip_force, 2) << braces;
    EXPECT_EQ(mechanism.load.torque, 3) << braces;
  }
}

// A pair that the file omits is written completely, with the default as the other number.
TEST(Edit, WritesOmittedPairCompletely) {
  const std::string text = k_good_file;
  const DeclaredMechanism plain = parse_mechanism(text, "plain");
  const DeclaredMechanism edited = parse_mechanism(
      edit_values(text, {{"joint.attachment1_mm[1]", 55}, {"joint.length_mm", 110}, {"joint.attachment2_mm[0]", 3}}),
      "edited");
  ASSERT_TRUE(edited.joint.attachment1 && edited.joint.attachment2);
  EXPECT_FALSE(plain.joint.attachment1 || plain.joint.attachment2);
  EXPECT_EQ(edited.joint.attachment1->across, 0);
  EXPECT_EQ(edited.joint.attachment1->along, 55);
  EXPECT_EQ(edited.joint.attachment2->across, 3);
  EXPECT_EQ(edited.joint.attachment2->along, 110) << "default: C of the edited joint.length_mm";
  EXPECT_EQ(edit_values(text, {{"joint.attachment1_mm[0]", -2}, {"joint.attachment1_mm[1]", 40}}),
            edit_values(text, {{"joint.attachment1_mm[1]", 40}, {"joint.attachment1_mm[0]", -2}}));
}

TEST(Edit, ReachesInlineTables) {
  const std::string text =
      "schema = 1\njoint = {length_mm = 100, range_deg = [-30, 30]}\nguides = { EB_mm = 50, ED_mm = 50, OE_mm = -40 }\n"
      "pulley = {EF_mm = 80, r1_mm = 16}\ntendon.diameter_mm = 1\n";
  const std::string edited =
      edit_values(text, {{"joint.length_mm", 90.0}, {"guides.friction", 0.3}, {"tendon.diameter_mm", 2.0}});
  const DeclaredMechanism mechanism = parse_mechanism(edited, "f.toml");
  EXPECT_EQ(mechanism.joint.R, 90.0);
  EXPECT_EQ(mechanism.guides.mu, 0.3);
  EXPECT_EQ(mechanism.tendon.diameter, 2.0);
}

TEST(Edit, ReplacesFormerKeys) {
  const std::string text = std::string(k_good_file) + "[identified]\nguide_outward_mm = 0.25 # both\n";
  EXPECT_EQ(parse_mechanism(text, "f.toml").identified.pins.left.outward, 0.25);
  EXPECT_EQ(parse_mechanism(text, "f.toml").identified.pins.right.outward, 0.25);
  const std::string edited = edit_values(text, {{"identified.guide2_outward_mm", 0.5}});
  EXPECT_EQ(edited,
            std::string(k_good_file) + "[identified]\nguide1_outward_mm = 0.25\nguide2_outward_mm = 0.5 # both\n");
  const std::string dotted = "identified.guide_outward_mm = 0.25\n" + std::string(k_good_file);
  EXPECT_EQ(parse_mechanism(edit_values(dotted, {}), "f.toml").identified.pins.right.outward, 0.25);
  const std::string both = text + "guide2_outward_mm = 0.5\n";
  EXPECT_THROW(parse_mechanism(both, "f.toml"), InputError);
}

// A new key is written beside the dotted keys of its table: at the top of the file it would precede the schema.
TEST(Edit, ReachesDottedKeys) {
  const std::string text =
      "schema = 1\njoint.range_deg = [\n  -30,\n  30]\njoint.length_mm = 100\n"
      "guides = { EB_mm = 50, ED_mm = 50, OE_mm = -40 }\npulley = {EF_mm = 80, r1_mm = 16}\n  tendon.diameter_mm = 1\n";
  const std::string edited =
      edit_values(text, {{"load.mass_kg", 0.5}, {"joint.length_mm", 90.0}, {"tendon.bend_ratio", 9.0}});
  const DeclaredMechanism mechanism = parse_mechanism(edited, "f.toml");
  EXPECT_EQ(mechanism.joint.R, 90.0);
  EXPECT_EQ(mechanism.tendon.diameter, 1.0);
  EXPECT_THAT(edited, ::testing::HasSubstr("  tendon.bend_ratio = 9\ntendon.diameter_mm = 1\n"));
}

TEST(Edit, AcceptsWindowsLineEnds) {
  std::string text;
  for (const char c : k_good_file) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const std::string edited = edit_values("\xEF\xBB\xBF" + text, {{"pulley.r1_mm", 17.5}, {"guides.friction", 0.25}});
  const DeclaredMechanism mechanism = parse_mechanism(edited, "f.toml");
  EXPECT_EQ(mechanism.pulley.r1, 17.5);
  EXPECT_EQ(mechanism.guides.mu, 0.25);
}

}  // namespace
}  // namespace fusee
