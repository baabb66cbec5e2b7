#include "mechanism/lengths.h"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <cmath>

#include "mechanism/linear_relation.h"
#include "mechanism/mechanism_text.h"

namespace fusee {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string k_inch_file =
    "schema = 1\nunits = \"inch\"\n[joint]\nlength_mm = 3.5\nrange_deg = [-30, 30]\n[guides]\nEB_mm = 1.75\nED_mm = "
    "1.75\n"
    "OE_mm = -1.4\nradius_mm = \"2 mm\"\n[pulley]\nEF_mm = 2.8\nr1_mm = 0.56\n[tendon]\ndiameter_mm = \"1 mm\"\n";

std::string error_of(const std::string& text, const std::vector<Setting>& settings = {}) {
  try {
    parse_mechanism(text, "f.toml", ".", settings);
  } catch (const InputError& error) {
    const Diagnostic& first = error.diagnostics().front();
    return std::to_string(first.place.line) + ":" + std::to_string(first.place.column) + " " + first.message + " | " +
           first.hint;
  }
  return "accepted";
}

TEST(Lengths, ReadTextsWithUnits) {
  const std::vector<std::pair<const char*, double>> good{
      {"45 mm", 45},         {"4.5cm", 45},       {"0.1 m", 100},     {"200 um", 0.2},      {"200 µm", 0.2},
      {"3.5 in", 88.9},      {"3.5in", 88.9},     {"3 1/2 in", 88.9}, {"3-1/2 inch", 88.9}, {"1/8 in", 3.175},
      {"1.1 inches", 27.94}, {"2\"", 50.8},       {"2″", 50.8},       {"10 thou", 0.254},   {"-1 1/2 in", -38.1},
      {"+.5 in", 12.7},      {" 1e-1 in ", 2.54}, {"0 in", 0},        {"1e3 mm", 1000},     {"2 in.", 50.8}};
  for (const auto& [text, mm] : good) EXPECT_EQ(parse_length(text), mm) << text;
  for (const char* bad : {"", "3.5", "in", "3,5 in", "3.5 kg", "1/0 in", "1/2/3 in", "1.5 1/2 in", "3 in 2", "nan mm",
                          "inf in", "--1 in", "1e999 mm", "3 1/ in", "/2 in", "3.5 IN"})
    EXPECT_FALSE(parse_length(bad)) << bad;
}

TEST(Lengths, AreRoundedOnce) {
  for (int hundredths = -50000; hundredths <= 50000; ++hundredths) {
    const double inches = hundredths / 100.0, mm = hundredths * 254 / 1000.0;
    ASSERT_EQ(to_mm(inches, LengthUnit::inch), mm) << inches;
  }
  EXPECT_TRUE(std::isinf(to_mm(INFINITY, LengthUnit::inch)));
}

// The file's unit survives writing, and each value reads back as exactly the same.
TEST(Lengths, ReadBackExactly) {
  rc::check([] {
    const double mm =
        *rc::gen::element(1.0, -1.0) * std::ldexp(*rc::gen::inRange(1LL, 1LL << 52), *rc::gen::inRange(-70, -35));
    const std::string text = length_value_text(mm, LengthUnit::inch);
    const double back = text.front() == '"' ? parse_length(text.substr(1, text.size() - 2)).value()
                                            : to_mm(std::stod(text), LengthUnit::inch);
    RC_ASSERT(back == mm);
  });
  EXPECT_EQ(length_value_text(88.9, LengthUnit::inch), "3.5");
  EXPECT_EQ(length_value_text(0.2, LengthUnit::inch), "\"0.2 mm\"");
  EXPECT_EQ(length_value_text(0, LengthUnit::inch), "0");
  EXPECT_EQ(length_value_text(88.9, LengthUnit::mm), "88.9");
}

TEST(Lengths, AreTheKeysInMm) {
  for (const Field& field : fields())
    EXPECT_EQ(field.unit == "mm" || (field.table == "prior" && field.key.ends_with("_mm")), is_length(field.key))
        << field.name();
}

TEST(Lengths, EqualThoseOfFileInMm) {
  DeclaredMechanism inch = parse_mechanism(k_inch_file, "f.toml");
  const DeclaredMechanism mm = parse_mechanism(
      "schema = 1\n[joint]\nlength_mm = \"8.89 cm\"\nrange_deg = [-30, 30]\n[guides]\nEB_mm = 44.45\nED_mm = 44.45\n"
      "OE_mm = -35.56\n[pulley]\nEF_mm = \"2.8 in\"\nr1_mm = 14.224\n[tendon]\ndiameter_mm = 1\n",
      "f.toml");
  EXPECT_EQ(inch.units, LengthUnit::inch);
  inch.units = LengthUnit::mm;
  EXPECT_EQ(inch, mm);
}

TEST(Lengths, ReadSettingsInTheFilesUnit) {
  const std::vector<Setting> settings{
      {"pulley.r1_mm", "0.6"},       {"guides.EB_mm", "1 3/4 in"},       {"guides.ED_mm", "2\""},
      {"pulley.EF_mm", "\"70 mm\""}, {"joint.attachment1_mm[0]", "0.5"}, {"joint.attachment2_mm", "[\"1 cm\", 3]"}};
  const DeclaredMechanism m = parse_mechanism(k_inch_file, "f.toml", ".", settings);
  EXPECT_EQ(m.pulley.r1, 15.24);
  EXPECT_EQ(m.guides.EB, 44.45);
  EXPECT_EQ(m.guides.ED, 50.8);
  EXPECT_EQ(m.pulley.EF, 70);
  EXPECT_EQ(m.joint.attachment1->across, 12.7);
  EXPECT_EQ(m.joint.attachment2->across, 10);
  EXPECT_EQ(m.joint.attachment2->along, 76.2);
  EXPECT_EQ(parse_mechanism(k_good_file, "f.toml", ".", {{"pulley.r1_mm", "0.6 in"}}).pulley.r1, 15.24);
}

TEST(Lengths, ReadListsInTheFilesUnit) {
  const std::string text =
      k_inch_file +
      "[prior]\nEB_mm = [1.75, \"0.02 mm\"]\nguide_give_mm_per_N = [0.01, 0.001]\n[optimize]\n"
      "variables = [\"guides.ED_mm\", \"joint.range_deg[1]\"]\nlower = [1, 20]\nupper = [\"5 cm\", 40]\n"
      "constraints = [\"guides.ED_mm <= 0.5 * joint.length_mm + 1\"]\n";
  const DeclaredMechanism m = parse_mechanism(text, "f.toml");
  EXPECT_THAT(m.prior.EB, ElementsAre(44.45, 0.02));
  EXPECT_THAT(m.prior.guide_compliance, ElementsAre(0.01, 0.001));
  EXPECT_THAT(m.optimize.lower, ElementsAre(25.4, 20));
  EXPECT_THAT(m.optimize.upper, ElementsAre(50, 40));
  EXPECT_EQ(parse_mechanism(write_mechanism(m), "written"), m);
  const LinearRelation limit = parse_relation(m.optimize.constraints.front(), m.units).relation;
  EXPECT_DOUBLE_EQ(limit.right.value(m), 0.5 * 88.9 + 25.4);
}

TEST(Lengths, KeepMeaningOfTies) {
  const DeclaredMechanism m = parse_mechanism(k_inch_file, "f.toml");
  const auto right = [&](const char* text) { return parse_relation(text, LengthUnit::inch).relation.right.value(m); };
  EXPECT_DOUBLE_EQ(right("guides.EB_mm = 2 * joint.range_deg[1]"), 60 * 25.4);   // range 30 deg: 60 in
  EXPECT_DOUBLE_EQ(right("joint.range_deg[1] = 10 * joint.length_mm + 1"), 36);  // length 3.5 in: 36 deg
  EXPECT_TRUE(depends_on_units("guides.EB_mm <= 50"));
  EXPECT_FALSE(depends_on_units("guides.EB_mm <= 0.5 * joint.length_mm"));
}

TEST(Lengths, ReportErrorsInTheFilesUnit) {
  EXPECT_EQ(error_of(replaced(k_inch_file, "length_mm = 3.5", "length_mm = 3500")),
            "4:13 joint.length_mm = 3500 in is out of range | allowed: 0.03937 to 393.7 in");
  EXPECT_EQ(error_of(replaced(k_inch_file, "length_mm = 3.5", "length_mm = \"20 m\"")),
            "4:13 joint.length_mm = \"20 m\" is out of range | allowed: 0.03937 to 393.7 in");
  EXPECT_THAT(error_of(replaced(k_good_file, "length_mm = 100", "length_mm = \"3,5 in\"")),
              testing::AllOf(HasSubstr("4:13 joint.length_mm must be a number in mm, not the string \"3,5 in\""),
                             HasSubstr("\"3 1/2 in\"")));
  EXPECT_THAT(error_of(k_good_file + "[body]\nmin_wall_in = 0.05\n"),
              HasSubstr("unknown key body.min_wall_in | min_wall_mm takes a text with its unit, such as \"3.5 in\""));
  EXPECT_THAT(error_of(replaced(k_inch_file, "\"inch\"", "\"cm\"")),
              HasSubstr("2:9 units = \"cm\" is not known | allowed: \"mm\" or \"inch\""));
  EXPECT_THAT(error_of(replaced(k_inch_file, "\"inch\"", "\"inches\"")), HasSubstr("did you mean \"inch\"?"));
  EXPECT_THAT(
      error_of(k_inch_file + "[horn]\nspline_teeth = 25\nspline_diameter_mm = 0.1\nspline_depth_mm = 0.5\n[body]\n"
                             "bore = \"horn\"\n"),
      HasSubstr("horn.spline_depth_mm = 0.5 in exceeds the width of the teeth, 0.01256 in"));
}

TEST(Lengths, WriteEditsInTheFilesUnit) {
  const std::string edited = edit_values(k_inch_file, {{"pulley.r1_mm", 15.24},
                                                       {"guides.radius_mm", 2.54},
                                                       {"body.min_wall_mm", 1.2},
                                                       {"joint.attachment1_mm[0]", 25.4}});
  EXPECT_THAT(edited, HasSubstr("r1_mm = 0.6\n"));
  EXPECT_THAT(edited, HasSubstr("radius_mm = 0.1\n"));
  EXPECT_THAT(edited, HasSubstr("min_wall_mm = \"1.2 mm\"\n"));
  EXPECT_THAT(edited, HasSubstr("attachment1_mm = [1, 3.5]\n"));
}

TEST(Lengths, ConvertMessages) {
  const auto inch = [](const char* text) { return lengths_in(LengthUnit::inch, text); };
  EXPECT_EQ(inch("at least 0.5 mm clearance is required"), "at least 0.0197 in clearance is required");
  EXPECT_EQ(inch("20.9 × 20.9 × 17.2 mm, 3 mm², 5 mm/N, 2 mm per N, M3"),
            "0.8228 × 0.8228 × 0.6772 in, 3 mm², 5 mm/N, 2 mm per N, M3");
  EXPECT_EQ(inch("varies 10-fold, 4.94 to 51.8 mm"), "varies 10-fold, 0.1945 to 2.039 in");
  EXPECT_EQ(inch("both [-10000, 10000] mm"), "both [-393.701, 393.701] in");
  EXPECT_EQ(inch("tendons cut 1 at 360 mm, 2 at 355 mm"), "tendons cut 1 at 14.17 in, 2 at 13.98 in");
  EXPECT_EQ(inch("try pulley.r1_mm = 21.9964 or less (now 25.4)"), "try pulley.r1_mm = 0.866 or less (now 1)");
  EXPECT_EQ(inch("try pulley.r1_mm = 25.4 to 50.8 (now 12.7)"), "try pulley.r1_mm = 1 to 2 (now 0.5)");
  EXPECT_EQ(inch("try body.hub_diameter_mm = 14 (now automatic, 12.2)"),
            "try body.hub_diameter_mm = 0.551 (now automatic, 0.4803)");
  EXPECT_EQ(inch("prior.OE_mm = [2.4, 0.02] or joint.range_deg = [-30, 30]"),
            "prior.OE_mm = [0.0945, 0.000787] or joint.range_deg = [-30, 30]");
  EXPECT_EQ(inch("guides.OE_mm = 40 in place of -40 mm"), "guides.OE_mm = 1.57 in place of -1.57 in");
  EXPECT_EQ(inch("joint.length_mm = 3500 in is out of range"), "joint.length_mm = 3500 in is out of range");
  EXPECT_EQ(inch("P1 at 9.8e-05 mm, tendon 2 mm"), "P1 at 3.86e-06 in, tendon 0.0787 in");
  EXPECT_EQ(inch("a text has its unit: \"45 mm\""), "a text has its unit: \"45 mm\"");
  EXPECT_EQ(inch("−0.194 … −0.189 mm (offset_mm = -0.1917)"), "−0.007638 … −0.007441 in (offset_mm = -0.1917)");
  EXPECT_EQ(inch("1.5 N at 3 deg"), "1.5 N at 3 deg");
  EXPECT_EQ(inch("<dd>14.7 … 17.4\u00a0mm, 3\u00a0cm³"), "<dd>0.5787 … 0.685\u00a0in, 3\u00a0cm³");
  EXPECT_EQ(lengths_in(LengthUnit::mm, "at 3 mm"), "at 3 mm");
}

}  // namespace
}  // namespace fusee
