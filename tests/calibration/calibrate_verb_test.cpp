// The verb of the pipeline: what a user of the library gets without the program, and what page and JSON say.
#include <gmock/gmock.h>

#include <fstream>
#include <map>

#include "fusee/pipeline.h"
#include "pipeline/law_table_copy.h"

namespace fusee {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::filesystem::path k_rig = std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/data/rig";

std::filesystem::path scratch(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("fusee_verb_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

void leave(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::string> names(const std::vector<OutputFile>& outputs) {
  std::vector<std::string> all;
  for (const OutputFile& output : outputs) all.push_back(output.name);
  return all;
}

std::vector<std::filesystem::path> runs_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> runs;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") runs.push_back(entry.path());
  }
  std::sort(runs.begin(), runs.end());
  return runs;
}

CalibrateOptions into(const std::filesystem::path& folder) {
  CalibrateOptions options;
  options.folder = folder;
  return options;
}

TEST(CalibrateVerb, LeavesEveryFile) {
  const std::filesystem::path folder = scratch("all") / "out";
  std::vector<std::string> steps;
  CalibrateOptions options = into(folder);
  options.progress = [&](const std::string& what, std::optional<double> share) {
    if (!share) steps.push_back(what);
  };
  const CalibrateResult result =
      calibrate(read_mechanism(k_rig / "c_backlash/spec.toml"), runs_in(k_rig / "c_backlash"), options);
  EXPECT_THAT(names(result.outputs),
              ElementsAre("calibration.json", "corrected.toml", "compensation.csv", "report.html", "manifest.json"));
  EXPECT_TRUE(result.published);
  EXPECT_FALSE(result.rewritten);
  EXPECT_EQ(result.product.calibration.verdict, CalibrationVerdict::explained);
  EXPECT_THAT(steps, ElementsAre("reading the runs", "looking for slips of the file", "working out the correction"));
  for (const OutputFile& one : result.outputs) EXPECT_EQ(read_file(folder / one.name, 1 << 22), one.bytes);
}

TEST(CalibrateVerb, WhatIsThrownBeforeWritingLeavesNothing) {
  const std::filesystem::path folder = scratch("thrown") / "out";
  CalibrateOptions options = into(folder);
  options.before_writing = [] { throw std::runtime_error("enough"); };
  EXPECT_THROW(
      calibrate(read_mechanism(k_rig / "e_one_sweep_only/spec.toml"), {k_rig / "e_one_sweep_only/run_1.csv"}, options),
      std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(CalibrateVerb, ARunHeldOutIsNotFittedAndAFileCountsOnce) {
  CalibrateOptions options = into(scratch("held"));
  options.dry_run = true;
  const std::vector<std::filesystem::path> runs = runs_in(k_rig / "c_backlash");
  options.hold_out = {runs.back(), runs.back().parent_path() / "." / runs.back().filename()};
  std::vector<std::filesystem::path> twice = runs;
  twice.push_back(runs.front());
  const CalibrateResult result = calibrate(read_mechanism(k_rig / "c_backlash/spec.toml"), twice, options);
  EXPECT_EQ(result.product.measurement.runs.size(), runs.size());
  EXPECT_THAT(result.product.calibration.held_out_runs, ElementsAre(runs.back().filename().string()));
  EXPECT_FALSE(result.published);
}

TEST(CalibrateVerb, ASlipIsSaidAndChangesNothingElse) {
  CalibrateOptions options = into(scratch("slip"));
  options.dry_run = true;
  const MechanismFile file = read_mechanism(k_rig / "a_declared_right/spec.toml", {{"guides.OE_mm", "14"}});
  const CalibrateResult result = calibrate(file, runs_in(k_rig / "a_declared_right"), options);
  EXPECT_EQ(result.product.calibration.verdict, CalibrationVerdict::unexplained);
  std::map<std::string, std::string> outputs;
  for (const OutputFile& output : result.outputs) outputs[output.name] = output.bytes;
  ASSERT_EQ(result.product.slips.size(), 1u);
  const std::string words = slip_words(result.product.slips.front());
  EXPECT_THAT(words, testing::StartsWith("guides.OE_mm = -14 in place of 14 would explain the data to 0.0"));
  EXPECT_THAT(outputs["calibration.json"],
              testing::AllOf(HasSubstr("\"key\": \"guides.OE_mm\""), HasSubstr("\"would_be\": -14"), HasSubstr(words)));
  EXPECT_THAT(outputs["report.html"], HasSubstr(words));
  EXPECT_THAT(outputs["corrected.toml"], Not(HasSubstr("OE_mm = -14")));
  ASSERT_FALSE(result.product.file.warnings.empty());  // the same slip was seen in the file alone
  EXPECT_THAT(result.product.file.warnings.front().message, HasSubstr("guides.OE_mm = 14"));
}

TEST(CalibrateVerb, WithoutASlipTheListIsEmptyAndThePageHasNoSuchSection) {
  CalibrateOptions options = into(scratch("no_slip"));
  options.dry_run = true;
  const CalibrateResult result =
      calibrate(read_mechanism(k_rig / "c_backlash/spec.toml"), runs_in(k_rig / "c_backlash"), options);
  EXPECT_THAT(result.product.file.warnings, testing::IsEmpty());
  EXPECT_THAT(calibration_json(result.product), HasSubstr("\"slips\": []"));
  EXPECT_THAT(calibration_report_html(result.product), Not(HasSubstr("A slip of the file")));
}

/// The rig's runs with the tip force given as a torque.
TEST(CalibrateVerb, ATorqueIsWorthItsTipForce) {
  const std::filesystem::path folder = scratch("torque");
  const MechanismFile file = read_mechanism(k_rig / "b_stretch/spec.toml");
  std::vector<std::filesystem::path> torques;
  const std::vector<std::filesystem::path> forces = runs_in(k_rig / "b_stretch");
  for (const auto& run : forces) {
    std::string text = read_file(run, 1 << 22);
    const std::size_t header = text.find("load_N");
    ASSERT_NE(header, std::string::npos);
    text.replace(header, 6, "tau_Nmm");
    torques.push_back(folder / run.filename());
    leave(torques.back(), text);
  }
  const Measurement measurement = read_measurement(forces, file.mechanism);
  MeasurementOptions columns;
  columns.columns = {{"load", "tau_Nmm"}};
  const Measurement converted = read_measurement(torques, file.mechanism, columns);
  EXPECT_EQ(converted.load_unit, "N");
  EXPECT_THAT(converted.notes, testing::Contains(HasSubstr("holds a torque in Nmm: taken as a tip force")));
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    EXPECT_NEAR(converted.runs[r].mean_load, measurement.runs[r].mean_load / file.mechanism.joint.R, 1e-12);
    EXPECT_NEAR(converted.runs[r].samples[9].load, measurement.runs[r].samples[9].load / file.mechanism.joint.R, 1e-12);
  }
}

// ---- the table of law = "table" -------------------------------------------------------------------------------------

/// The forearm with its law as a table in a folder of its own; the table's name stands in a comment and in the name
/// too.
MechanismFile tabled(const std::filesystem::path& folder, const std::string& quoted = "\"laws/law.csv\"") {
  std::filesystem::create_directories(folder / "laws");
  std::string law = "alpha_deg,theta_deg\n";
  for (int i = -10; i <= 10; ++i) law += std::to_string(15 * i) + "," + std::to_string(3 * i) + "\n";
  leave(folder / "laws/law.csv", law);
  leave(folder / "arm.toml", "# \"laws/law.csv\" is measured\nschema = 1\nname = \"laws/law.csv\"\n" + std::string(R"(
[joint]
length_mm = 100
range_deg = [-30, 30]
[guides]
EB_mm = 50
ED_mm = 50
OE_mm = -40
radius_mm = 2
[pulley]
EF_mm = 80
law = "table"
table = )") + quoted + "  # not \"laws/law.csv\" of last year\n[tendon]\ndiameter_mm = 1\n");
  return read_mechanism(folder / "arm.toml");
}

TEST(LawTable, TheValueAloneIsEdited) {
  const MechanismFile file = tabled(scratch("law"));
  const std::string text = read_file(file.path, 1 << 20);
  std::string expected = text;
  expected.replace(expected.find("table = \"laws/law.csv\""), 22, "table = \"law.csv\"");
  EXPECT_EQ(with_table_beside(text, file), expected);
  EXPECT_EQ(law_table_copy(file).name, "law.csv");
  EXPECT_EQ(law_table_copy(file).bytes,
            read_file(std::filesystem::path(file.path).parent_path() / "laws/law.csv", 9999));
}

TEST(LawTable, OtherWaysToWriteItAreFound) {
  for (const char* quoted : {"'laws/law.csv'", "\"laws\\u002Flaw.csv\""}) {
    const std::filesystem::path folder = scratch("quoted");
    const MechanismFile file = tabled(folder, quoted);
    const std::string text = with_table_beside(read_file(file.path, 1 << 20), file);
    const Mechanism read = parse_mechanism(text, "corrected.toml", folder / "laws");
    EXPECT_EQ(read.pulley.table, "law.csv") << quoted;
    EXPECT_EQ(read.pulley.rows, file.mechanism.pulley.rows) << quoted;
    EXPECT_EQ(read.name, file.mechanism.name) << quoted;
  }
}

TEST(LawTable, OfTorqueGoesBesideToo) {
  const std::filesystem::path folder = scratch("torque");
  const MechanismFile law = tabled(folder);
  leave(folder / "laws/torque.csv", "theta_deg,motor_torque_Nmm\n-30,300\n-10,310\n10,320\n30,330\n");
  std::string text = read_file(law.path, 1 << 20);
  text.replace(text.find("law = \"table\""), 13, "law = \"torque\"");
  text.replace(text.find("table = \"laws/law.csv\""), 22, "torque_table = \"laws/torque.csv\"");
  leave(folder / "arm.toml", text);
  const MechanismFile file = read_mechanism(folder / "arm.toml");
  EXPECT_EQ(law_table_copy(file).name, "torque.csv");
  const Mechanism read = parse_mechanism(with_table_beside(text, file), "corrected.toml", folder / "laws");
  EXPECT_EQ(read.pulley.torque_table, "torque.csv");
  EXPECT_EQ(read.pulley.torque_rows, file.mechanism.pulley.torque_rows);
}

TEST(LawTable, BesideItsFileItStaysAsItIs) {
  const std::filesystem::path folder = scratch("beside");
  MechanismFile file = tabled(folder);
  file.mechanism.pulley.table = "law.csv";
  EXPECT_EQ(with_table_beside("anything \"law.csv\"", file), "anything \"law.csv\"");
}

// ---- page and JSON --------------------------------------------------------------------------------------------------

CalibrationProduct explained() {
  CalibrationProduct product;
  product.file = read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles/forearm.toml");
  product.calibration.verdict = CalibrationVerdict::explained;
  return product;
}

TEST(CalibrationPage, APulleyThatCannotBeMadeIsNotNothing) {
  CalibrationProduct product = explained();
  product.correction.infeasible = "tendon 2 leaves pin D at α = 115°";
  const std::string page = calibration_report_html(product);
  EXPECT_THAT(page, HasSubstr("The pulley that would correct this cannot be made: tendon 2 leaves pin D at α = 115°."));
  EXPECT_THAT(page, Not(HasSubstr("Nothing was identified")));
  EXPECT_THAT(calibration_json(product), HasSubstr("\"infeasible\": \"tendon 2 leaves pin D"));
}

TEST(CalibrationPage, SaysWhereToTie) {
  CalibrationProduct product = explained();
  product.correction.has_pulley = true;
  product.correction.tied_at = radians(-1.5);
  EXPECT_THAT(calibration_report_html(product), HasSubstr("the motor at -1.5 deg"));
  EXPECT_THAT(calibration_json(product), HasSubstr("\"tied_at_deg\": -1.5"));
}

TEST(CalibrationPage, SaysWhatIsPerhapsBesideAName) {
  CalibrationProduct product = explained();
  FoundEffect stretch;
  stretch.name = "tendon_stretch";
  stretch.group = {"tendon_stretch", "joint_sensor_gain"};
  product.calibration.effects = {stretch};
  EXPECT_THAT(calibration_json(product), Not(HasSubstr("\"beside\"")));
  EXPECT_THAT(calibration_report_html(product), Not(HasSubstr("Perhaps")));
  product.calibration.effects.front().beside = {{"joint_sensor_gain", {{"gain_percent", 1.25, 1, 1.5, 1, 1.5}}}};
  EXPECT_THAT(calibration_json(product), HasSubstr("\"beside\""));
  EXPECT_THAT(calibration_report_html(product),
              HasSubstr("Perhaps joint sensor gain (gain = 1.25 % (95 %: 1 … 1.5)) beside it"));
}

TEST(CalibrationPage, SaysNeitherWhereThereIsNothingToSay) {
  const std::string json = calibration_json(explained());
  EXPECT_THAT(json, Not(HasSubstr("infeasible")));
  EXPECT_THAT(json, Not(HasSubstr("tied_at_deg")));
  EXPECT_THAT(calibration_report_html(explained()), HasSubstr("Nothing was identified"));
}

}  // namespace
}  // namespace fusee
