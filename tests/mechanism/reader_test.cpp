#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "mechanism/mechanism_text.h"

namespace fusee {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<Diagnostic> errors_of(const std::string& text, const std::vector<Setting>& settings = {}) {
  try {
    parse_mechanism(text, "f.toml", ".", settings);
  } catch (const InputError& error) {
    return error.diagnostics();
  }
  return {};
}

/// "4:13 message | hint" of the only error.
std::string only_error(const std::string& text, const std::vector<Setting>& settings = {}) {
  const std::vector<Diagnostic> errors = errors_of(text, settings);
  if (errors.size() != 1) return "not one error but " + std::to_string(errors.size());
  const Diagnostic& error = errors.front();
  return std::to_string(error.place.line) + ":" + std::to_string(error.place.column) + " " + error.message + " | " +
         error.hint;
}

std::string with(const std::string& from, const std::string& to) { return replaced(k_good_file, from, to); }

TEST(Reader, ReadsUnits) {
  const DeclaredMechanism m =
      parse_mechanism(k_good_file + "[material]\nshrinkage_percent = 0.5\n[body]\ngroove_angle_deg = 60\n", "f.toml");
  EXPECT_EQ(m.name, "test");
  EXPECT_EQ(m.joint.R, 100);
  EXPECT_DOUBLE_EQ(m.joint.theta_min, -30 * std::acos(-1.0) / 180);
  EXPECT_EQ(m.guides.OE, -40);
  EXPECT_EQ(m.pulley.r1, 16);
  EXPECT_DOUBLE_EQ(m.material.shrinkage, 0.005);
  EXPECT_DOUBLE_EQ(m.body.groove_angle, std::acos(-1.0) / 3);
}

TEST(Reader, FillsInDefaults) {
  const DeclaredMechanism m = parse_mechanism(k_good_file, "f.toml");
  EXPECT_EQ(m.guides.radius, 2);
  EXPECT_EQ(m.guides.mu, 0.12);
  EXPECT_EQ(m.pulley.law, Law::compensate);
  EXPECT_EQ(m.pulley.method, Method::exact);
  EXPECT_EQ(m.tendon.modulus, 40000);
  EXPECT_EQ(m.body.set_screw, "auto");
  EXPECT_TRUE(m.body.nut_trap);
  EXPECT_EQ(m.cut.sheet_width, 300);
  EXPECT_EQ(m.material.name, "PLA");
  EXPECT_FALSE(m.transmission.has_value());
}

TEST(Reader, ReportsPlaceOfEachKindOfError) {
  EXPECT_EQ(only_error(with("length_mm = 100", "length_mm = \"abc\"")),
            "4:13 joint.length_mm must be a number in mm, not the string \"abc\" | allowed: 1 to 10000 mm; a "
            "text has its unit: \"3 1/2 in\", \"4.5 cm\" or \"45 mm\"");
  EXPECT_EQ(only_error(with("length_mm = 100", "length_mm = -5")),
            "4:13 joint.length_mm = -5 mm is out of range | allowed: 1 to 10000 mm");
  EXPECT_EQ(only_error(with("length_mm = 100", "length_mm = nan")),
            "4:13 joint.length_mm must be a finite number, not nan | allowed: 1 to 10000 mm");
  EXPECT_EQ(only_error(with("OE_mm = -40", "OE_mm = inf")),
            "9:9 guides.OE_mm must be a finite number, not inf | allowed: -10000 to 10000 mm");
  EXPECT_THAT(only_error(with("EB_mm = 50\n", "")),
              HasSubstr("6:2 missing key guides.EB_mm | add EB_mm = ... under [guides]"));
  EXPECT_THAT(only_error(with("schema = 1", "schema = 2")), HasSubstr("1:10 schema = 2 is out of range"));
  EXPECT_THAT(only_error(with("schema = 1\n", "")),
              HasSubstr("0:0 missing key schema | add schema = 1 at the top of the file"));
  EXPECT_THAT(only_error(k_good_file + "[body]\nnut_trap = 1\n"),
              HasSubstr("16:12 body.nut_trap must be true or false, not the number 1"));
  EXPECT_THAT(only_error(with("name = \"test\"", "name = 4")),
              HasSubstr("2:8 name must be a text in quotes, not the number 4"));
  EXPECT_THAT(only_error(with("name = \"test\"", "name = 2020-01-01")),
              HasSubstr("2:8 name must be a text in quotes, not a date or time"));
  EXPECT_THAT(only_error(with("name = \"test\"", "name = \"a\\nb\"")),
              HasSubstr("2:8 name = \"a\\nb\" contains a character"));
  EXPECT_THAT(only_error(with("[tendon]\n", "law = \"linea\"\nratio = 2\n[tendon]\n")),
              HasSubstr("13:7 pulley.law = \"linea\" is not known"));
}

TEST(Reader, ReadsAttachmentsAndDrum) {
  const DeclaredMechanism plain = parse_mechanism(k_good_file, "f.toml");
  EXPECT_TRUE(plain.joint.is_plain());
  const std::string wide =
      with("length_mm = 100\n", "length_mm = 100\ndrum_radius_mm = 20\nattachment2_mm = [-3, 40.5]\n");
  const DeclaredMechanism m = parse_mechanism(wide, "f.toml");
  EXPECT_EQ(m.joint.drum_radius, 20);
  EXPECT_EQ(m.joint.attachment2, (Attachment{-3, 40.5}));
  EXPECT_FALSE(m.joint.attachment1);
  EXPECT_THAT(only_error(with("length_mm = 100\n", "length_mm = 100\nattachment1_mm = [1, 2, 3]\n")),
              HasSubstr("joint.attachment1_mm must be two numbers [across, along] in mm, not a list of 3"));
  EXPECT_THAT(only_error(with("length_mm = 100\n", "length_mm = 100\nattachment1_mm = [1, inf]\n")),
              HasSubstr("must be a finite number, not inf"));
  EXPECT_THAT(
      only_error(wide,
                 {{"pulley.method", "paper"}, {"joint.attachment2_mm", "[0, 100]"}, {"joint.drum_radius_mm", "0"}}),
      HasSubstr("joint.attachment2_mm cannot be combined with pulley.method = \"paper\""));
  const std::string rubbing = with("length_mm = 100\n", "length_mm = 100\ndrum_radius_mm = 20\ndrum_friction = 0.2\n");
  EXPECT_EQ(parse_mechanism(rubbing, "f.toml").joint.drum_mu, 0.2);
  // --set of one number of a pair, over the file's value or the default C.
  EXPECT_EQ(parse_mechanism(wide, "f.toml", ".", {{"joint.attachment2_mm[0]", "7"}}).joint.attachment2,
            (Attachment{7, 40.5}));
  EXPECT_EQ(parse_mechanism(wide, "f.toml", ".", {{"joint.attachment1_mm[0]", "-7"}}).joint.attachment1,
            (Attachment{-7, 100}));
  EXPECT_THAT(only_error(wide, {{"joint.attachment2_mm[1]", "x"}}), HasSubstr("joint.attachment2_mm must be"));
}

/// --set of one end of a range, as advice names it.
TEST(Reader, SetsEndsOfRange) {
  const Joint joint = parse_mechanism(k_good_file, "f.toml", ".", {{"joint.range_deg[1]", "12.5"}}).joint;
  EXPECT_NEAR(degrees(joint.theta_max), 12.5, 1e-12);
  EXPECT_EQ(joint.theta_min, parse_mechanism(k_good_file, "f.toml").joint.theta_min);
  EXPECT_THAT(only_error(k_good_file, {{"joint.range_deg[0]", "3"}}), HasSubstr("does not include home"));
  EXPECT_THAT(only_error(k_good_file, {{"joint.range_deg[1]", "x"}}), HasSubstr("joint.range_deg must be"));
  EXPECT_THAT(only_error(k_good_file, {{"joint.range_deg[2]", "3"}}), HasSubstr("unknown key"));
  EXPECT_THAT(only_error(with("range_deg = [-30.0, 30.0]\n", ""), {{"joint.range_deg[1]", "20"}}),
              HasSubstr("missing key"));
}

TEST(Reader, ReadsSheaths) {
  EXPECT_FALSE(parse_mechanism(k_good_file, "f.toml").sheath.is_there());
  const std::string sheathed = with(
      "[pulley]\n", "[sheath]\nlength_mm = 400\nbend_deg = 180\nexit_across_mm = 20\nexit_above_mm = 60\n[pulley]\n");
  const DeclaredMechanism m = parse_mechanism(sheathed, "f.toml");
  EXPECT_EQ(m.sheath, (Sheath{400, radians(180), 0.08, 0, 20, 60}));
  EXPECT_FALSE(m.is_papers());
  EXPECT_THAT(only_error(with("[pulley]\n", "[sheath]\nlength_mm = 400\nbend_deg = 9\nexit_above_mm = 60\n[pulley]\n")),
              HasSubstr("missing key sheath.exit_across_mm (required with [sheath])"));
  EXPECT_THAT(only_error(sheathed, {{"pulley.method", "paper"}}),
              HasSubstr("[sheath] cannot be combined with pulley.method = \"paper\""));
  EXPECT_THAT(only_error(sheathed, {{"sheath.exit_above_mm", "0"}}), HasSubstr("out of range"));
  EXPECT_THAT(only_error(sheathed, {{"sheath.friction", "nan"}}), HasSubstr("finite"));
}

TEST(Reader, ReadsIdlers) {
  const std::string idlers = with("OE_mm = -40\n", "OE_mm = -40\nradius_mm = 6.0\nkind = \"idler\"\n");
  std::vector<Diagnostic> warnings;
  const DeclaredMechanism m = parse_mechanism(idlers, "f.toml", ".", {}, &warnings);
  EXPECT_EQ(m.guides.kind, GuideKind::idler);
  EXPECT_EQ(m.guides.bearing_radius, 1.5);
  EXPECT_THAT(only_error(idlers, {{"guides.bearing_radius_mm", "6.1"}}),
              HasSubstr("does not fit into an idler of 6 mm"));
  EXPECT_THAT(only_error(idlers, {{"guides.kind", "roller"}}), HasSubstr("guides.kind = \"roller\" is not known"));
}

TEST(Reader, ReadsMotor) {
  EXPECT_FALSE(parse_mechanism(k_good_file, "f.toml").motor.is_there());
  const auto motor = [](const std::string& keys) { return with("[tendon]\n", "[motor]\n" + keys + "[tendon]\n"); };
  const DeclaredMechanism m = parse_mechanism(
      motor("model = \"MG996R\"\ntravel_deg = 120\nspeed_rpm = 55\njoint_speed_deg_per_s = 90\nenforce = true\n"),
      "f.toml");
  EXPECT_EQ(m.motor, (Motor{"MG996R", radians(120), 0, radians(330), 1, 0.9, radians(90), true}));
  EXPECT_THAT(write_mechanism(m), HasSubstr("speed_deg_per_s = 330\n"));
  EXPECT_EQ(parse_mechanism(write_mechanism(m), "g.toml"), m);
  EXPECT_THAT(only_error(motor("model = \"mg996r\"\n")), HasSubstr("did you mean \"MG996R\"?"));
  EXPECT_THAT(only_error(motor("travel_deg = 0\n")), HasSubstr("motor.travel_deg = 0 deg is out of range"));
  EXPECT_THAT(only_error(motor("stall_torque_Nmm = \"strong\"\n")), HasSubstr("must be a number in Nmm"));
  EXPECT_THAT(only_error(motor("speed_deg_per_s = 300\nspeed_rpm = 50\n")), HasSubstr("both define the motor's speed"));
  EXPECT_THAT(only_error(motor("enforce = true\n")), HasSubstr("has no limit to enforce"));
  std::vector<Diagnostic> warnings;
  parse_mechanism(motor("travel_deg = 180\njoint_speed_deg_per_s = 90\n"), "f.toml", ".", {}, &warnings);
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_THAT(warnings[0].message, HasSubstr("the motor's speed is unknown"));
  EXPECT_THAT(warnings[0].hint, HasSubstr("choose motor.model"));
}

TEST(Reader, RejectsRangeWithoutHome) {
  EXPECT_THAT(only_error(with("[-30.0, 30.0]", "[10, 20]")),
              HasSubstr("5:13 joint.range_deg = [10, 20] deg does not include home"));
  EXPECT_THAT(only_error(with("[-30.0, 30.0]", "[0, 0]")), HasSubstr("does not include home"));
  EXPECT_THAT(only_error(with("[-30.0, 30.0]", "[30, -30]")), HasSubstr("does not include home"));
  EXPECT_THAT(only_error(with("[-30.0, 30.0]", "[-30]")),
              HasSubstr("5:13 joint.range_deg must be two numbers [lowest, highest] in deg, not a list of 1"));
  EXPECT_THAT(only_error(with("[-30.0, 30.0]", "[-30.0, nan]")),
              HasSubstr("5:21 joint.range_deg must be a finite number"));
  EXPECT_THAT(only_error(with("[-30.0, 30.0]", "[-300, 30.0]")),
              HasSubstr("5:14 joint.range_deg = -300 deg is out of range"));
  EXPECT_THAT(errors_of(with("[-30.0, 30.0]", "[0, 30]")), IsEmpty());
}

TEST(Reader, SuggestsNearestKey) {
  EXPECT_THAT(only_error(k_good_file + "diametr_mm = 2\n"),
              HasSubstr("15:1 unknown key tendon.diametr_mm | did you mean diameter_mm?"));
  EXPECT_THAT(only_error(with("[guides]", "EF_mm = 80\n[guides]")),
              HasSubstr("6:1 unknown key joint.EF_mm | pulley.EF_mm: EF_mm belongs in [pulley]"));
  EXPECT_THAT(only_error(with("schema = 1", "schema = 1\nlength_mm = 4")),
              HasSubstr("2:1 unknown key length_mm | joint.length_mm: length_mm belongs in [joint]"));
  EXPECT_THAT(only_error(k_good_file + "[bdy]\nbore = \"d\"\n"),
              HasSubstr("15:2 unknown table [bdy] | did you mean [body]?"));
  EXPECT_THAT(only_error(k_good_file + "[calibrate]\n"), HasSubstr("unknown table [calibrate]"));
  EXPECT_THAT(only_error(k_good_file + "[tendon.sub]\na = 1\n"), HasSubstr("unknown key tendon.sub"));
  EXPECT_THAT(only_error(with("schema = 1", "schema = 1\nbody = 4")),
              HasSubstr("2:1 body is a table, not the number 4"));
  EXPECT_THAT(only_error(with("schema = 1", "schema = 1\n\"joint.length_mm\" = 4")),
              HasSubstr("2:1 unknown key joint.length_mm"));
}

TEST(Reader, ReportsAllErrorsInFileOrder) {
  std::string text = with("length_mm = 100", "length_mm = 0");
  text = replaced(text, "ED_mm = 50", "ED_m = 50");
  text = replaced(text, "r1_mm = 16", "r1_mm = true");
  std::vector<int> lines;
  for (const Diagnostic& error : errors_of(text, {{"tendon.modulus_MPa", "soft"}})) lines.push_back(error.place.line);
  EXPECT_THAT(lines, ElementsAre(4, 6, 8, 12, 0));  // 6: ED_mm is missing from [guides]
}

TEST(Reader, CountsExcessErrors) {
  std::string text = k_good_file + "[body]\n";
  for (int i = 0; i < 500; ++i) text += "zzzzzzzzzzzzzzzz" + std::to_string(i) + " = 1\n";
  const std::vector<Diagnostic> errors = errors_of(text);
  ASSERT_THAT(errors, SizeIs(101));
  EXPECT_EQ(errors.back().message, "and 400 more errors");
}

TEST(Reader, RequiresKeyOfLaw) {
  EXPECT_THAT(only_error(with("r1_mm = 16\n", "")),
              HasSubstr("missing key pulley.r1_mm (required with law = \"compensate\")"));
  EXPECT_THAT(only_error(with("r1_mm = 16\n", "law = \"linear\"\n")),
              HasSubstr("missing key pulley.ratio (required with law = \"linear\")"));
  EXPECT_THAT(only_error(with("r1_mm = 16\n", "law = \"table\"\n")),
              HasSubstr("missing key pulley.table (required with law = \"table\")"));
  EXPECT_THAT(only_error(with("r1_mm = 16\n", "law = \"linear\"\nratio = -2\n")),
              HasSubstr("13:9 pulley.ratio = -2 is out of range"));
  // An unknown law requires no key of another law.
  EXPECT_THAT(only_error(with("r1_mm = 16\n", "law = \"quadratic\"\n")),
              HasSubstr("12:7 pulley.law = \"quadratic\" is not known"));
}

TEST(Reader, RequiresOneWantedTorque) {
  const std::string law = "law = \"torque\"\n";
  EXPECT_THAT(only_error(with("r1_mm = 16\n", law)),
              HasSubstr("12:7 pulley.law = \"torque\" requires a wanted torque"));
  EXPECT_THAT(only_error(with("r1_mm = 16\n", law + "torque_table = \"none.csv\"\n")),
              HasSubstr("13:16 pulley.torque_table: ./none.csv: cannot be read"));
  EXPECT_THAT(only_error(with("r1_mm = 16\n", law + "motor_torque_Nmm = 900\nmethod = \"paper\"\n")),
              HasSubstr("14:10 pulley.law = \"torque\" cannot be combined with pulley.method"));
  const DeclaredMechanism m = parse_mechanism(
      with("r1_mm = 16\n", law + "motor_torque_Nmm = -900\n[spring]\nstiffness_Nmm_per_rad = 400\nfree_deg = 90\n"),
      "f.toml", ".");
  EXPECT_EQ(m.pulley.law, Law::torque);
  EXPECT_EQ(m.pulley.motor_torque, -900);
  EXPECT_EQ(m.spring, (Spring{400, 0, radians(90)}));
  EXPECT_EQ(parse_mechanism(write_mechanism(m), "g.toml", "."), m);
}

TEST(Reader, LoadsTorqueTable) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "fusee_reader_torque";
  std::filesystem::create_directories(folder);
  const std::string text = with("r1_mm = 16\n", "law = \"torque\"\ntorque_table = \"torque.csv\"\n");
  std::ofstream(folder / "joint.toml") << text;
  std::ofstream(folder / "torque.csv") << "theta_deg,motor_torque_Nmm\n-30,800\n-10,900\n10,950\n30,1000\n";
  const DeclaredMechanism m = read_mechanism(folder / "joint.toml").mechanism;
  ASSERT_THAT(m.pulley.torque_rows, SizeIs(4));
  EXPECT_EQ(m.pulley.torque_rows[1].torque, 900);
  EXPECT_EQ(parse_mechanism(write_mechanism(m), "g.toml", folder), m);
  try {
    read_mechanism(folder / "joint.toml", {{"pulley.motor_torque_Nmm", "900"}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("both define the wanted torque"));
  }
  std::filesystem::remove_all(folder);
}

TEST(Reader, WarnsOfUnusedKeys) {
  std::vector<Diagnostic> warnings;
  parse_mechanism(with("r1_mm = 16\n", "r1_mm = 16\nlaw = \"linear\"\nratio = 2\n"), "f.toml", ".", {}, &warnings);
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_EQ(to_text(warnings[0]),
            "f.toml:12:9: warning: pulley.r1_mm is not used: it is for law = \"compensate\" only");
  parse_mechanism(with("length_mm = 100\n", "length_mm = 100\ndrum_friction = 0.2\n"), "f.toml", ".", {}, &warnings);
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_THAT(warnings[0].message, HasSubstr("joint.drum_friction is not used"));
  parse_mechanism(k_good_file, "f.toml", ".", {}, &warnings);
  EXPECT_THAT(warnings, IsEmpty());
}

TEST(Reader, ReadsBoreAndHorn) {
  EXPECT_THAT(only_error(k_good_file + "[body]\nbore = \"horn\"\n"),
              HasSubstr("16:8 body.bore = \"horn\" requires a horn"));
  EXPECT_THAT(only_error(k_good_file + "[body]\nbore = \"horn\"\nhorn = \"lynxmotion\"\n"),
              HasSubstr("17:8 body.horn = \"lynxmotion\" is not known | did you mean \"lynxmotion-ses\"?"));
  EXPECT_THAT(errors_of(k_good_file + "[body]\nbore = \"horn\"\nhorn = \"lynxmotion-ses\"\n"), IsEmpty());
}

TEST(Reader, AcceptsRatioInPlaceOfMechanism) {
  const DeclaredMechanism m =
      parse_mechanism("schema = 1\n[transmission]\nkind = \"ratio\"\nratio = -1.093\n", "f.toml");
  ASSERT_TRUE(m.transmission.has_value());
  EXPECT_EQ(m.transmission->ratio, -1.093);
  const std::vector<Diagnostic> both = errors_of(k_good_file + "[transmission]\nkind = \"ratio\"\nratio = 2\n");
  ASSERT_THAT(both, SizeIs(3));
  EXPECT_EQ(both[0].place.line, 3);
  EXPECT_EQ(both[0].message, "[joint] and [transmission] cannot both be declared");
  EXPECT_THAT(only_error("schema = 1\n[transmission]\nkind = \"ratio\"\nratio = 0\n"),
              HasSubstr("4:9 transmission.ratio must not be 0"));
  EXPECT_THAT(only_error("schema = 1\n[transmission]\nratio = 2\n"), HasSubstr("2:2 missing key transmission.kind"));
}

TEST(Reader, SettingsAddAndReplace) {
  EXPECT_EQ(parse_mechanism(k_good_file, "f.toml", ".", {{"guides.EB_mm", "60"}}).guides.EB, 60);
  EXPECT_EQ(parse_mechanism(with("EB_mm = 50\n", ""), "f.toml", ".", {{"guides.EB_mm", "60"}}).guides.EB, 60);
  EXPECT_EQ(
      parse_mechanism(with("EB_mm = 50\n", "EB_mm = \"bad\"\n"), "f.toml", ".", {{"guides.EB_mm", "60"}}).guides.EB,
      60);
  EXPECT_EQ(parse_mechanism(k_good_file, "f.toml", ".", {{"name", "my arm"}}).name, "my arm");
  EXPECT_EQ(parse_mechanism(k_good_file, "f.toml", ".", {{"name", "\"x = 1\""}}).name, "x = 1");
  EXPECT_EQ(parse_mechanism(k_good_file, "f.toml", ".", {{"pulley.law", "linear"}, {"pulley.ratio", "2"}}).pulley.law,
            Law::linear);
  EXPECT_EQ(parse_mechanism(k_good_file, "f.toml", ".", {{"body.nut_trap", "false"}}).body.nut_trap, false);
  const DeclaredMechanism ranged = parse_mechanism(k_good_file, "f.toml", ".", {{"joint.range_deg", "[-20, 10]"}});
  EXPECT_DOUBLE_EQ(ranged.joint.theta_max, std::acos(-1.0) / 18);
  // The last setting counts.
  EXPECT_EQ(parse_mechanism(k_good_file, "f.toml", ".", {{"guides.EB_mm", "60"}, {"guides.EB_mm", "70"}}).guides.EB,
            70);
}

TEST(Reader, AdvisesOnWrongSyntax) {
  EXPECT_THAT(only_error(with("length_mm = 100", "length_mm = 17,0 # R")), HasSubstr("decimal point: 17.0"));
  EXPECT_THAT(only_error(with("name = \"test\"", "name = forearm")), HasSubstr("in quotes: \"forearm\""));
  EXPECT_THAT(only_error(with("[-30.0, 30.0]", "[30, -30]")), HasSubstr("stands first: [-30, 30]"));
}

TEST(Reader, ErrorsNameSettings) {
  const auto text_of = [](const Setting& setting) {
    const std::vector<Diagnostic> errors = errors_of(k_good_file, {setting});
    return errors.size() == 1 ? to_text(errors.front()) : "not one error";
  };
  EXPECT_THAT(text_of({"guides.EB_mm", "abc"}),
              HasSubstr("--set guides.EB_mm=abc: error: guides.EB_mm must be a number in mm, not the string \"abc\""));
  EXPECT_THAT(text_of({"guides.EB_m", "4"}), HasSubstr("unknown key guides.EB_m\n  hint: did you mean guides.EB_mm?"));
  EXPECT_THAT(text_of({"guide.EB_mm", "4"}), HasSubstr("unknown table \"guide\"\n  hint: did you mean guides?"));
  EXPECT_THAT(text_of({"EB_mm", "4"}), HasSubstr("guides.EB_mm: EB_mm belongs in [guides]"));
  EXPECT_THAT(text_of({"guides.EB_mm", ""}), HasSubstr("\"\" is not a value"));
  EXPECT_THAT(text_of({"guides.EB_mm", "4\nED_mm = 5"}), HasSubstr("is not a value"));
  EXPECT_THAT(text_of({"guides.EB_mm", "[[[[[[[[[[[[[[[[[[[[[[[[1"}), HasSubstr("is not a value"));
  EXPECT_THAT(text_of({"guides.EB_mm", "1e999"}), HasSubstr("guides.EB_mm must be a"));
}

TEST(Reader, RequiresUncertaintyOfPrior) {
  EXPECT_TRUE(errors_of(k_good_file + "[prior]\nguide_radius_mm = [2.4, 0.02]\nEB_mm = []\n").empty());
  for (const char* wrong : {"[2.4]", "[2.4, 0]", "[2.4, -0.1]", "[2.4, 0.1, 0.2]"}) {
    const std::string error = only_error(k_good_file + "[prior]\nguide_radius_mm = " + wrong + "\n");
    EXPECT_THAT(error, HasSubstr("prior.guide_radius_mm must be two numbers")) << wrong;
  }
}

TEST(Reader, ReportsPlaceOfSyntaxErrors) {
  EXPECT_THAT(only_error("schema = 1\nname = \n"), HasSubstr("2:8 not TOML: "));
  EXPECT_THAT(only_error("schema = 1\nschema = 1\n"), HasSubstr("2:"));
  EXPECT_THAT(only_error("[\x01"), HasSubstr("1:2 not TOML: "));
  EXPECT_THAT(only_error("name = \"\xff\xfe\"\n"), HasSubstr("1:"));
}

TEST(Reader, RejectsOtherFiles) {
  EXPECT_THAT(only_error(""), HasSubstr("0:0 is empty"));
  EXPECT_THAT(only_error(" \n\r\n\t"), HasSubstr("0:0 is empty"));
  EXPECT_THAT(only_error(std::string("\x7f"
                                     "ELF\0\0",
                                     6)),
              HasSubstr("is a binary file"));
  EXPECT_THAT(only_error(std::string((1 << 20) + 1, '#')), HasSubstr("larger than 1 MB"));
}

TEST(Reader, RejectsControlCharacters) {
  for (const char* odd :
       {"\\u001B[2J", "\\u009B31m", "\\u202Ex", "\\u2066x", "\\u200F", "\\uFFFE", "\\n", "\\t", "\\u007F"}) {
    const std::string error = only_error(with("\"test\"", "\"x" + std::string(odd) + "\""));
    EXPECT_THAT(error, HasSubstr("2:8 name = \"x\\")) << odd;
    EXPECT_THAT(error, HasSubstr("contains a character that a one-line text must not have")) << odd;
    EXPECT_THAT(only_error(k_good_file + "[material]\nname = \"" + odd + "\"\n"), HasSubstr("material.name = ")) << odd;
    EXPECT_THAT(only_error(k_good_file + "[optimize]\nvariables = [\"" + odd + "\"]\n"),
                HasSubstr("optimize.variables = "))
        << odd;
  }
  EXPECT_THAT(errors_of(with("\"test\"", "\"größe \\\\ é 日本 \\uFFFD\"")), IsEmpty());
}

TEST(Reader, RejectsLengthsBelowMicrometre) {
  int keys = 0;
  for (const Field& field : fields()) {
    if (field.unit != "mm" || field.least != 0 || field.table == "identified") continue;
    ++keys;
    for (const char* value : {"5e-324", "1e-300", "1e-12", "0.00099"}) {
      const std::vector<Diagnostic> errors = errors_of(k_good_file, {{field.name(), value}});
      ASSERT_FALSE(errors.empty()) << field.name();
      EXPECT_THAT(errors.front().message, HasSubstr("is less than a micrometre")) << field.name();
      EXPECT_THAT(errors.front().hint, HasSubstr("0, or at least 0.001 mm"));
    }
    for (const Diagnostic& error : errors_of(k_good_file, {{field.name(), "0.001"}}))
      EXPECT_THAT(error.message, testing::Not(HasSubstr("micrometre")));
  }
  EXPECT_GT(keys, 20);
}

TEST(Reader, RejectsDeepNesting) {
  std::string dots = "a";
  for (int i = 0; i < 100000; ++i) dots += ".a";
  EXPECT_THAT(only_error(dots + " = 1\n"), HasSubstr("nest too deep"));
  EXPECT_THAT(only_error("x = 1\n[" + dots + "]\n"), HasSubstr("2:"));
  EXPECT_THAT(only_error("a = " + std::string(100000, '[')), HasSubstr("1:21 tables or lists nest too deep"));
  // Brackets and dots in strings and comments are text.
  const std::string brackets(50, '['), points(50, '.');
  EXPECT_THAT(errors_of(with("\"test\"", "\"" + brackets + "\\\"" + points + "\" # " + brackets + points)), IsEmpty());
  EXPECT_THAT(errors_of(with("\"test\"", "'''" + brackets + points + "'''")), IsEmpty());
}

TEST(Reader, ReadsFilesAndHashesThem) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "fusee_reader";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "joint.toml", std::ios::binary) << k_good_file;
  const MechanismFile file = read_mechanism(folder / "joint.toml", {{"guides.EB_mm", "60"}});
  EXPECT_EQ(file.mechanism.guides.EB, 60);
  EXPECT_EQ(file.sha256, sha256(k_good_file));
  EXPECT_EQ(file.path, (folder / "joint.toml").string());
  EXPECT_THROW(read_mechanism(folder), InputError);
  EXPECT_THROW(read_mechanism(folder / "missing.toml"), InputError);
  // A sparse file of 100 MB is rejected before it is read.
  std::ofstream(folder / "large.toml").close();
  std::filesystem::resize_file(folder / "large.toml", 100u << 20);
  try {
    read_mechanism(folder / "large.toml");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("is larger than 1048576 bytes"));
  }
  std::filesystem::remove_all(folder);
}

TEST(Reader, LoadsLawTable) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "fusee_reader_table";
  std::filesystem::create_directories(folder);
  const std::string text = with("r1_mm = 16\n", "law = \"table\"\ntable = \"law.csv\"\n");
  std::ofstream(folder / "joint.toml") << text;
  EXPECT_THAT(only_error(text), HasSubstr("13:9 pulley.table: ./law.csv: cannot be read"));
  std::ofstream(folder / "law.csv") << "alpha_deg,theta_deg\n-90,-30\n-45,-15\n0,0\n45,15\n90,30\n";
  const DeclaredMechanism m = read_mechanism(folder / "joint.toml").mechanism;
  ASSERT_THAT(m.pulley.rows, SizeIs(5));
  EXPECT_DOUBLE_EQ(m.pulley.rows[4].alpha, std::acos(-1.0) / 2);
  std::ofstream(folder / "law.csv") << "alpha_deg,theta_deg\n-90,-30\n-45,-15\n0,0\n45,-15\n90,30\n";
  try {
    read_mechanism(folder / "joint.toml");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("law.csv:5:1: error: theta_deg does not increase: -15 deg after 0 deg"));
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace fusee
