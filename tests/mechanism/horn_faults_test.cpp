// Validation of [horn] and body.shaft: contradictions are reported at their place with a remedy, valid tables without
// messages.
#include <gmock/gmock.h>

#include "fusee/mechanism_file.h"
#include "mechanism/mechanism_text.h"

namespace fusee {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// "line:column message | hint" of each error, one per line.
std::string errors_of(const std::string& keys, const std::vector<Setting>& settings = {}) {
  std::string text;
  try {
    parse_mechanism(k_good_file + keys, "f.toml", ".", settings);
  } catch (const InputError& error) {
    for (const Diagnostic& one : error.diagnostics()) {
      text += std::to_string(one.place.line) + ":" + std::to_string(one.place.column) + " " + one.message + " | " +
              one.hint + "\n";
    }
  }
  return text;
}

/// [body] on line 15, [horn] on line 17; the first of `keys` on line 18.
std::string of_horn(const std::string& keys) { return errors_of("[body]\nbore = \"horn\"\n[horn]\n" + keys); }

const std::string k_disc = "bolt_circle_mm = 16\nbolt_count = 4\nbolt_hole_mm = 2.2\ncentre_hole_mm = 5\n";
const std::string k_boss = "boss_diameter_mm = 8\nboss_height_mm = 1.9\n";
const std::string k_spline = "spline_teeth = 25\nspline_diameter_mm = 5.92\nspline_depth_mm = 0.3\n";
const std::string k_shoulder = "spline_length_mm = 4\ncentre_hole_mm = 3.2\n";

TEST(OwnHorn, AcceptsValidHorns) {
  for (const std::string& horn :
       {k_disc, k_disc + k_boss, k_disc + "first_bolt_deg = -30\n", k_spline, k_spline + k_shoulder}) {
    EXPECT_EQ(of_horn(horn), "") << horn;
    std::vector<Diagnostic> warnings;
    parse_mechanism(k_good_file + "[body]\nbore = \"horn\"\n[horn]\n" + horn, "f.toml", ".", {}, &warnings);
    EXPECT_THAT(warnings, IsEmpty()) << horn;
  }
}

TEST(OwnHorn, ReadsUnits) {
  const Horn horn =
      parse_mechanism(k_good_file + "[body]\nbore = \"horn\"\n[horn]\nfirst_bolt_deg = 90\n" + k_disc + k_boss,
                      "f.toml")
          .horn;
  EXPECT_EQ(horn, (Horn{16, 4, 2.2, 0.5 * k_pi, 5, 8, 1.9}));
}

TEST(OwnHorn, RejectsIncompleteScrewCircle) {
  EXPECT_THAT(of_horn("bolt_circle_mm = 16\nbolt_hole_mm = 2.2\ncentre_hole_mm = 5\n"),
              HasSubstr("17:2 horn.bolt_count is missing or 0 | add bolt_count under [horn]: number of screws on the "
                        "circle of 16 mm"));
  EXPECT_THAT(of_horn("bolt_count = 0\n"
                      "bolt_circle_mm = 16\nbolt_hole_mm = 2.2\ncentre_hole_mm = 5\n"),
              HasSubstr("18:14 horn.bolt_count is missing"));
  EXPECT_THAT(of_horn("bolt_count = 4\nbolt_hole_mm = 2.2\ncentre_hole_mm = 5\n"),
              HasSubstr("horn.bolt_circle_mm is missing"));
  EXPECT_THAT(of_horn("bolt_circle_mm = 16\nbolt_count = 4\ncentre_hole_mm = 5\n"),
              HasSubstr("horn.bolt_hole_mm is missing"));
  EXPECT_THAT(of_horn("bolt_circle_mm = 16\nbolt_count = 4\nbolt_hole_mm = 2.2\n"),
              HasSubstr("horn.centre_hole_mm is missing"));
  EXPECT_THAT(of_horn(k_boss + "centre_hole_mm = 5\n"), HasSubstr("horn.bolt_circle_mm is missing"));
}

TEST(OwnHorn, RejectsIncompleteBoss) {
  EXPECT_THAT(of_horn(k_disc + "boss_diameter_mm = 8\n"), HasSubstr("horn.boss_height_mm is missing"));
  EXPECT_THAT(of_horn(k_disc + "boss_height_mm = 2\n"), HasSubstr("horn.boss_diameter_mm is missing"));
}

TEST(OwnHorn, RejectsShaftTogetherWithHorn) {
  EXPECT_THAT(
      of_horn(k_spline + k_boss),
      HasSubstr("18:16 horn.spline_teeth is for the servo's bare shaft, horn.boss_diameter_mm for a horn | leave out"));
  EXPECT_THAT(of_horn(k_spline + "bolt_circle_mm = 16\n"), HasSubstr("horn.bolt_circle_mm for a horn"));
}

TEST(OwnHorn, RejectsIncompleteShaft) {
  EXPECT_THAT(of_horn("spline_diameter_mm = 5.92\nspline_depth_mm = 0.3\ncentre_hole_mm = 3\n"),
              HasSubstr("horn.spline_teeth is missing"));
  EXPECT_THAT(of_horn("spline_teeth = 25\nspline_depth_mm = 0.3\n"), HasSubstr("horn.spline_diameter_mm is missing"));
  EXPECT_THAT(of_horn("spline_teeth = 25\nspline_diameter_mm = 5.92\n"), HasSubstr("horn.spline_depth_mm is missing"));
  EXPECT_THAT(of_horn(k_spline + "spline_length_mm = 4\n"), HasSubstr("horn.centre_hole_mm is missing"));
  EXPECT_THAT(of_horn(k_spline + "centre_hole_mm = 3\n"), HasSubstr("add spline_length_mm"));
  EXPECT_THAT(of_horn("spline_teeth = 5\nspline_diameter_mm = 5.92\nspline_depth_mm = 0.3\n"),
              HasSubstr("is too small"));
  // π · 5.92 mm / 25 = 0.744 mm
  EXPECT_THAT(of_horn("spline_teeth = 25\nspline_diameter_mm = 5.92\nspline_depth_mm = 0.8\n"),
              HasSubstr("20:19 horn.spline_depth_mm = 0.8 mm exceeds the width of the teeth, 0.744 mm"));
}

TEST(OwnHorn, RejectsFractionalCounts) {
  EXPECT_THAT(of_horn("bolt_count = 3.5\n"
                      "bolt_circle_mm = 16\nbolt_hole_mm = 2.2\ncentre_hole_mm = 5\n"),
              HasSubstr("18:14 horn.bolt_count must be a whole number, not 3.5"));
  EXPECT_EQ(of_horn("bolt_count = 3.0\n"
                    "bolt_circle_mm = 16\nbolt_hole_mm = 2.2\ncentre_hole_mm = 5\n"),
            "");
}

TEST(OwnHorn, RejectsTwoHorns) {
  EXPECT_THAT(errors_of("[body]\nbore = \"horn\"\nhorn = \"disc-25T-M3\"\n[horn]\n" + k_disc),
              HasSubstr("19:18 horn.bolt_circle_mm describes a horn, and body.horn = \"disc-25T-M3\" names another | "
                        "leave out either body.horn or [horn]"));
  EXPECT_EQ(errors_of("[body]\nbore = \"horn\"\nhorn = \"disc-25T-M3\"\n[horn]\nbolt_count = 0\n"), "");
  EXPECT_THAT(errors_of("[body]\nbore = \"horn\"\n[horn]\n"),
              HasSubstr("16:8 body.bore = \"horn\" requires a horn | name one with body.horn"));
}

TEST(OwnHorn, WarnsOfUnusedHorn) {
  std::vector<Diagnostic> warnings;
  parse_mechanism(k_good_file + "[horn]\nbolt_circle_mm = 16\n", "f.toml", ".", {}, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].message, "horn.bolt_circle_mm is not used: it is for bore = \"horn\" only");
}

TEST(Shaft, SetsBore) {
  const Body body = parse_mechanism(k_good_file + "[body]\nshaft = \"n20-d3\"\n", "f.toml").body;
  EXPECT_EQ(body.bore, Bore::d);
  EXPECT_EQ(body.bore_diameter, 3);
  EXPECT_EQ(body.bore_flat, 2.5);
  EXPECT_EQ(parse_mechanism(k_good_file, "f.toml", ".", {{"body.shaft", "nema23-round6.35"}}).body.bore_diameter, 6.35);
  EXPECT_EQ(parse_mechanism(k_good_file, "f.toml").body.bore_diameter, 0);
}

TEST(Shaft, RejectsContradictingBore) {
  EXPECT_EQ(errors_of("[body]\nshaft = \"n20-d3\"\nbore = \"d\"\nbore_diameter_mm = 3\nbore_flat_mm = 2.5\n"), "");
  EXPECT_THAT(
      errors_of("[body]\nshaft = \"n20-d3\"\nbore_diameter_mm = 4\n"),
      HasSubstr("17:20 body.bore_diameter_mm = 4 mm is not that of body.shaft = \"n20-d3\", which is 3 mm | leave "
                "out body.bore_diameter_mm"));
  EXPECT_THAT(errors_of("[body]\nshaft = \"n20-d3\"\nbore = \"horn\"\nhorn = \"disc-25T-M3\"\n"),
              HasSubstr("body.bore = \"horn\" is not that of body.shaft = \"n20-d3\", which is \"d\""));
  EXPECT_THAT(errors_of("[body]\nshaft = \"n20d3\"\n"),
              AllOf(HasSubstr("is not known"), HasSubstr("did you mean \"n20-d3\"?")));
}

}  // namespace
}  // namespace fusee
