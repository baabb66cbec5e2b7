// pipeline::calibrate(): its outputs, its next measurements, and the texts of page and JSON.
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fusee/pipeline.h"
#include "fusee/plan.h"
#include "mechanism/effect.h"
#include "pipeline/law_table_copy.h"

namespace fusee::calibration {
namespace {

using testing::Contains;
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

void write_text(const std::filesystem::path& path, const std::string& text) {
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

pipeline::CalibrateOptions into(const std::filesystem::path& folder) {
  pipeline::CalibrateOptions options;
  options.folder = folder;
  return options;
}

TEST(CalibrateVerb, WritesEveryFile) {
  const std::filesystem::path folder = scratch("all") / "out";
  std::vector<std::string> steps;
  const pipeline::CalibrateOptions options = into(folder);
  const RunContext context{.progress = [&](std::string_view step, std::optional<double> share) {
    if (!share) steps.emplace_back(step);
  }};
  const pipeline::CalibrateResult result = pipeline::calibrate(read_mechanism(k_rig / "c_backlash/spec.toml"),
                                                               runs_in(k_rig / "c_backlash"), options, context);
  EXPECT_THAT(names(result.outputs),
              ElementsAre("calibration.json", "corrected.toml", "compensation.csv", "report.html", "manifest.json"));
  EXPECT_TRUE(result.published);
  EXPECT_FALSE(result.rewritten);
  EXPECT_EQ(result.product.calibration.verdict, CalibrationVerdict::explained);
  EXPECT_THAT(steps, ElementsAre("reading the runs", "checking for input errors", "computing the correction"));
  for (const OutputFile& one : result.outputs) EXPECT_EQ(read_file(folder / one.name, 1 << 22), one.bytes);
}

TEST(CalibrateVerb, WritesNextMeasurements) {
  const std::filesystem::path folder = scratch("next") / "out";
  const std::filesystem::path data = k_rig / "e_one_sweep_only";
  const pipeline::CalibrateResult result =
      pipeline::calibrate(read_mechanism(data / "spec.toml"), {data / "run_1.csv"}, into(folder));
  ASSERT_FALSE(result.product.calibration.next.empty());
  EXPECT_THAT(names(result.outputs), Contains("next/bench.html"));
  EXPECT_TRUE(std::filesystem::is_regular_file(folder / "next/bench.html"));
  const nlohmann::json document = nlohmann::json::parse(read_file(folder / "calibration.json", 1 << 22));
  const nlohmann::json& first = document["next"][0];
  EXPECT_EQ(first["kind"], "caliper");
  EXPECT_EQ(first["key"], "prior.radius_offset_mm");
  EXPECT_THAT(first["separates"], testing::IsSupersetOf({"radius_offset", "pulley_scale"}));
  EXPECT_GT(first["minutes"], 0);
  EXPECT_EQ(first["text"], result.product.calibration.next.front().text());
  EXPECT_FALSE(first.contains("file"));
  // With a caliper reading, the measurement is not requested again.
  const MechanismFile read = read_mechanism(data / "spec.toml", {{"prior.radius_offset_mm", "[-0.336, 0.005]"}});
  const pipeline::CalibrateResult after = pipeline::calibrate(read, {data / "run_1.csv"}, into(folder));
  for (const plan::NextMeasurement& next : after.product.calibration.next)
    EXPECT_THAT(next.words, Not(HasSubstr("radius_offset_mm")));
}

// Runs without information give the plan of a joint that was never measured.
TEST(CalibrateVerb, ProposesPlanForUntestableRuns) {
  const std::filesystem::path folder = scratch("still");
  std::string still = "alpha_deg,theta_deg\n";
  for (int i = 0; i < 50; ++i) still += "1,2\n";
  write_text(folder / "still.csv", still);
  const MechanismFile file = read_mechanism(k_rig / "c_backlash/spec.toml");
  const pipeline::CalibrateResult result = pipeline::calibrate(file, {folder / "still.csv"}, into(folder / "out"));
  EXPECT_EQ(result.product.calibration.verdict, CalibrationVerdict::not_testable);
  const plan::Plan plan = plan::plan_runs(file.mechanism);
  ASSERT_EQ(result.product.calibration.next.size(), plan.steps.size());
  for (std::size_t i = 0; i < plan.steps.size(); ++i)
    EXPECT_THAT(result.product.calibration.next[i].words, HasSubstr(plan.steps[i].words));
  EXPECT_TRUE(std::filesystem::is_regular_file(folder / "out/next/run_1.csv"));
}

TEST(CalibrateVerb, WritesNoFolderWithoutOutputs) {
  const std::filesystem::path folder = scratch("none_next") / "out";
  const std::filesystem::path asked = k_rig / "e_one_sweep_only", clear = k_rig / "c_backlash";
  pipeline::calibrate(read_mechanism(asked / "spec.toml"), {asked / "run_1.csv"}, into(folder));
  EXPECT_TRUE(std::filesystem::exists(folder / "next"));
  const pipeline::CalibrateResult result =
      pipeline::calibrate(read_mechanism(clear / "spec.toml"), runs_in(clear), into(folder));
  EXPECT_THAT(result.product.calibration.next, testing::IsEmpty());
  EXPECT_THAT(formats::calibration_json(result.product), HasSubstr("\"next\": []"));
  EXPECT_FALSE(std::filesystem::exists(folder / "next"));
}

/// A calibration of the forearm whose runs include run_5.csv, with a next measurement of each kind.
formats::CalibrationProduct with_each_measurement() {
  formats::CalibrationProduct product;
  product.file = read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles/forearm.toml");
  product.measurement.runs.resize(2);
  product.measurement.runs[0].name = "slow.csv";
  product.measurement.runs[1].name = "run_5.csv";
  plan::PlannedRun run{.from = radians(-60.0), .to = radians(70.0), .cycles = 3, .speed = radians(12.0), .load = 5};
  plan::PlannedRun turned = run;
  turned.load = 0;
  turned.change = plan::BenchChange::joint_sensor_turned;
  const fusee::Effect& pins = *find_effect("guide_position", JointKind::tendons);
  product.calibration.next = {plan::next_run(run, run.speed, "N"), plan::next_inspection("tighten it"),
                              plan::next_reading({&pins.parameters[0], &pins.parameters[1]}),
                              plan::next_run(turned, run.speed, "N")};
  product.calibration.next[0].separates = {"tendon_stretch", "creep"};
  product.calibration.next[0].gain = "tendon_stretch from creep (5 × the uncertainty)";
  return product;
}

TEST(NextMeasurements, EachKindIsInTheDocument) {
  const nlohmann::json next = nlohmann::json::parse(formats::calibration_json(with_each_measurement()))["next"];
  ASSERT_EQ(next.size(), 4u);
  EXPECT_EQ(next[0]["kind"], "run");
  EXPECT_EQ(next[0]["file"], "next/run_6.csv");
  EXPECT_EQ(next[0]["separates"], nlohmann::json({"tendon_stretch", "creep"}));
  EXPECT_THAT(next[0]["text"].get<std::string>(), HasSubstr("at 5 N: it distinguishes tendon_stretch from creep"));
  EXPECT_EQ(next[1]["kind"], "inspect");
  EXPECT_FALSE(next[1].contains("file") || next[1].contains("key"));
  EXPECT_EQ(next[2]["kind"], "caliper");
  EXPECT_EQ(next[2]["key"], "prior.EB_mm");
  EXPECT_EQ(next[2]["keys"], nlohmann::json({"prior.EB_mm", "prior.OE1_mm"}));
  EXPECT_EQ(next[3]["kind"], "turn_sensor");
  EXPECT_EQ(next[3]["file"], "next/run_7.csv");
}

/// Fills in the empty column θ, as a user does.
std::string filled_in(const std::string& csv, double ratio) {
  std::istringstream lines(csv);
  std::string filled;
  double theta = 0;
  for (std::string line; std::getline(lines, line); filled += line + "\n") {
    if (line.empty() || line[0] == '#' || line[0] == 't') continue;
    std::size_t comma = 0;
    for (int i = 0; i < 3; ++i) comma = line.find(',', comma) + (i < 2 ? 1 : 0);
    theta = ratio * std::stod(line.substr(line.find(',') + 1));
    line.insert(comma + 1, std::to_string(theta));
  }
  return filled;
}

TEST(NextMeasurements, AreReadWhenFilledIn) {
  const formats::CalibrationProduct product = with_each_measurement();
  const std::filesystem::path folder = scratch("filled");
  const std::vector<OutputFile> files = formats::next_files(product);
  ASSERT_THAT(names(files), ElementsAre("next/bench.html", "next/run_6.csv", "next/run_7.csv"));
  EXPECT_THAT(files[0].bytes, testing::AllOf(HasSubstr("slow.csv run_5.csv run_6.csv run_7.csv"),
                                             HasSubstr("tighten it"), HasSubstr("hang"), HasSubstr("prior")));
  std::vector<std::filesystem::path> runs;
  for (std::size_t i = 1; i < files.size(); ++i) {
    runs.push_back(folder / std::filesystem::path(files[i].name).filename());
    write_text(runs.back(), filled_in(files[i].bytes, 0.2 + 0.01 * static_cast<double>(i)));
  }
  const measurement::Measurement read = measurement::read_measurement(runs, product.file.mechanism);
  EXPECT_THAT(read.not_testable, testing::IsEmpty());
  ASSERT_EQ(read.runs.size(), 2u);
  EXPECT_NEAR(read.runs[0].mean_load, 5, 1e-9);
  EXPECT_EQ(read.runs[0].mounting, joint::Mounting{});
  EXPECT_NEAR(degrees(read.runs[1].mounting.joint_sensor_turned), 90, 1e-9);
  for (const fusee::measurement::Run& run : read.runs) {
    EXPECT_EQ(run.strokes.size(), 6u);
    EXPECT_NEAR(run.speed, radians(12.0), 1e-3);
  }
}

TEST(CalibrateVerb, WritesNothingIfStopped) {
  const std::filesystem::path folder = scratch("thrown") / "out";
  const pipeline::CalibrateOptions options = into(folder);
  std::stop_source source;
  const RunContext context{.progress =
                               [&source](std::string_view step, std::optional<double>) {
                                 if (step == "computing the correction") source.request_stop();
                               },
                           .stop = source.get_token()};
  EXPECT_THROW(pipeline::calibrate(read_mechanism(k_rig / "e_one_sweep_only/spec.toml"),
                                   {k_rig / "e_one_sweep_only/run_1.csv"}, options, context),
               Stopped);
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(CalibrateVerb, HeldOutRunIsNotFitted) {
  pipeline::CalibrateOptions options = into(scratch("held"));
  options.dry_run = true;
  const std::vector<std::filesystem::path> runs = runs_in(k_rig / "c_backlash");
  options.hold_out = {runs.back(), runs.back().parent_path() / "." / runs.back().filename()};
  const pipeline::CalibrateResult result =
      pipeline::calibrate(read_mechanism(k_rig / "c_backlash/spec.toml"), runs, options);
  EXPECT_EQ(result.product.measurement.runs.size(), runs.size());
  EXPECT_THAT(result.product.calibration.held_out_runs, ElementsAre(runs.back().filename().string()));
  EXPECT_FALSE(result.published);
}

// compare() refuses it in the same words: a run that is given twice would confirm itself.
TEST(CalibrateVerb, RefusesRunGivenTwice) {
  const std::vector<std::filesystem::path> runs = runs_in(k_rig / "c_backlash");
  for (const std::filesystem::path& again : {runs[0], runs[0].parent_path() / "." / runs[0].filename()}) {
    try {
      pipeline::calibrate(read_mechanism(k_rig / "c_backlash/spec.toml"), {runs[0], runs[1], again},
                          into(scratch("twice")));
      FAIL() << again;
    } catch (const InputError& error) {
      EXPECT_EQ(error.diagnostics().front().message, "has the same rows as " + runs[0].string());
    }
  }
}

TEST(CalibrateVerb, InputErrorChangesNoOtherResult) {
  pipeline::CalibrateOptions options = into(scratch("input_error"));
  options.dry_run = true;
  const MechanismFile file = read_mechanism(k_rig / "a_declared_right/spec.toml", {{"guides.OE_mm", "14"}});
  const pipeline::CalibrateResult result = pipeline::calibrate(file, runs_in(k_rig / "a_declared_right"), options);
  EXPECT_EQ(result.product.calibration.verdict, CalibrationVerdict::unexplained);
  std::map<std::string, std::string> outputs;
  for (const OutputFile& output : result.outputs) outputs[output.name] = output.bytes;
  ASSERT_EQ(result.product.input_errors.size(), 1u);
  const std::string words = input_error_words(result.product.input_errors.front());
  EXPECT_THAT(words, testing::StartsWith("guides.OE_mm = -14 in place of 14 would explain the data to 0.0"));
  EXPECT_THAT(outputs["calibration.json"],
              testing::AllOf(HasSubstr("\"key\": \"guides.OE_mm\""), HasSubstr("\"would_be\": -14"), HasSubstr(words)));
  EXPECT_THAT(outputs["report.html"], HasSubstr(words));
  EXPECT_THAT(outputs["corrected.toml"], Not(HasSubstr("OE_mm = -14")));
  ASSERT_FALSE(result.product.file.warnings.empty());  // the same error was found in the file alone
  EXPECT_THAT(result.product.file.warnings.front().message, HasSubstr("guides.OE_mm = 14"));
}

/// The text of a run with θ moved by 50° in one row of 30. That is too often for outliers of a sensor.
std::string with_wild_rows(const std::string& text) {
  std::istringstream lines(text);
  std::string line, wild;
  for (int row = 0; std::getline(lines, line); ++row) {
    std::istringstream cells(line);
    std::string time, alpha, theta, rest;
    std::getline(cells, time, ',') && std::getline(cells, alpha, ',') && std::getline(cells, theta, ',') &&
        std::getline(cells, rest);
    if (row % 30 == 17) theta = std::to_string(std::stod(theta) + 50);
    wild += time + "," + alpha + "," + theta + "," + rest + "\n";
  }
  return wild;
}

TEST(CalibrateVerb, LeavesWildRowsOutOfEveryFigure) {
  const std::filesystem::path folder = scratch("wild"), made = k_rig / "a_declared_right";
  std::vector<std::filesystem::path> wild;
  for (const auto& run : runs_in(made)) {
    wild.push_back(folder / run.filename());
    write_text(wild.back(), with_wild_rows(read_file(run, 1 << 22)));
  }
  pipeline::CalibrateOptions options = into(folder / "out");
  options.dry_run = true;
  options.audit = false;
  const MechanismFile file = read_mechanism(made / "spec.toml");
  const Calibration found = pipeline::calibrate(file, wild, options).product.calibration;
  EXPECT_EQ(found.verdict, CalibrationVerdict::no_effect);
  EXPECT_GT(found.rows_left_out, 10u);
  EXPECT_THAT(found.summary,
              HasSubstr(" " + std::to_string(found.rows_left_out) + " rows are far from the neighbouring"));
  EXPECT_LT(found.before.rms, 1.2 * found.noise.rms);
  EXPECT_LT(found.before.max, 6 * found.noise.rms);
  EXPECT_LT(found.iso_before.A, 20 * found.noise.rms);
}

TEST(CalibrateVerb, RightFileListsNoInputError) {
  pipeline::CalibrateOptions options = into(scratch("no_input_error"));
  options.dry_run = true;
  const pipeline::CalibrateResult result =
      pipeline::calibrate(read_mechanism(k_rig / "c_backlash/spec.toml"), runs_in(k_rig / "c_backlash"), options);
  EXPECT_THAT(result.product.file.warnings, testing::IsEmpty());
  EXPECT_THAT(formats::calibration_json(result.product), HasSubstr("\"slips\": []"));
  EXPECT_THAT(formats::calibration_report_html(result.product), Not(HasSubstr("Likely input error")));
}

/// The rig's runs with the tip force given as a torque.
TEST(CalibrateVerb, ConvertsTorqueToTipForce) {
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
    write_text(torques.back(), text);
  }
  const measurement::Measurement measurement = measurement::read_measurement(forces, file.mechanism);
  measurement::MeasurementOptions columns;
  columns.columns = {{"load", "tau_Nmm"}};
  const measurement::Measurement converted = measurement::read_measurement(torques, file.mechanism, columns);
  EXPECT_EQ(converted.load_unit, "N");
  EXPECT_THAT(converted.notes, testing::Contains(HasSubstr("is a torque in Nmm: taken as a tip force")));
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    EXPECT_NEAR(converted.runs[r].mean_load, measurement.runs[r].mean_load / file.mechanism.joint.R, 1e-12);
    EXPECT_NEAR(converted.runs[r].samples[9].load, measurement.runs[r].samples[9].load / file.mechanism.joint.R, 1e-12);
  }
}

// ---- the table of law = "table" -------------------------------------------------------------------------------------

/// The forearm with its law as a table in a separate folder. The table's name also occurs in a comment and in the
/// joint's name.
MechanismFile joint_with_table(const std::filesystem::path& folder, const std::string& quoted = "\"laws/law.csv\"") {
  std::filesystem::create_directories(folder / "laws");
  std::string law = "alpha_deg,theta_deg\n";
  for (int i = -10; i <= 10; ++i) law += std::to_string(15 * i) + "," + std::to_string(3 * i) + "\n";
  write_text(folder / "laws/law.csv", law);
  write_text(
      folder / "arm.toml", "# \"laws/law.csv\" is measured\nschema = 1\nname = \"laws/law.csv\"\n" + std::string(R"(
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

TEST(LawTable, EditsValueOnly) {
  const MechanismFile file = joint_with_table(scratch("law"));
  const std::string text = read_file(file.path, 1 << 20);
  std::string expected = text;
  expected.replace(expected.find("table = \"laws/law.csv\""), 22, "table = \"law.csv\"");
  EXPECT_EQ(pipeline::with_table_beside(text, file, disk()), expected);
  EXPECT_EQ(pipeline::law_table_copy(file, disk()).name, "law.csv");
  EXPECT_EQ(pipeline::law_table_copy(file, disk()).bytes,
            read_file(std::filesystem::path(file.path).parent_path() / "laws/law.csv", 9999));
}

TEST(LawTable, FindsOtherSpellingsOfValue) {
  for (const char* quoted : {"'laws/law.csv'", "\"laws\\u002Flaw.csv\""}) {
    const std::filesystem::path folder = scratch("quoted");
    const MechanismFile file = joint_with_table(folder, quoted);
    const std::string text = pipeline::with_table_beside(read_file(file.path, 1 << 20), file, disk());
    const Mechanism read = parse_mechanism(text, "corrected.toml", folder / "laws");
    EXPECT_EQ(read.pulley.table, "law.csv") << quoted;
    EXPECT_EQ(read.pulley.rows, file.mechanism.pulley.rows) << quoted;
    EXPECT_EQ(read.name, file.mechanism.name) << quoted;
  }
}

TEST(LawTable, CopiesTorqueTable) {
  const std::filesystem::path folder = scratch("torque");
  const MechanismFile law = joint_with_table(folder);
  write_text(folder / "laws/torque.csv", "theta_deg,motor_torque_Nmm\n-30,300\n-10,310\n10,320\n30,330\n");
  std::string text = read_file(law.path, 1 << 20);
  text.replace(text.find("law = \"table\""), 13, "law = \"torque\"");
  text.replace(text.find("table = \"laws/law.csv\""), 22, "torque_table = \"laws/torque.csv\"");
  write_text(folder / "arm.toml", text);
  const MechanismFile file = read_mechanism(folder / "arm.toml");
  EXPECT_EQ(pipeline::law_table_copy(file, disk()).name, "torque.csv");
  const Mechanism read =
      parse_mechanism(pipeline::with_table_beside(text, file, disk()), "corrected.toml", folder / "laws");
  EXPECT_EQ(read.pulley.torque_table, "torque.csv");
  EXPECT_EQ(read.pulley.torque_rows, file.mechanism.pulley.torque_rows);
}

TEST(LawTable, StaysUnchangedBesideItsFile) {
  const std::filesystem::path folder = scratch("beside");
  MechanismFile file = joint_with_table(folder);
  file.mechanism.pulley.table = "law.csv";
  EXPECT_EQ(pipeline::with_table_beside("anything \"law.csv\"", file, disk()), "anything \"law.csv\"");
}

// ---- page and JSON --------------------------------------------------------------------------------------------------

formats::CalibrationProduct explained() {
  formats::CalibrationProduct product;
  product.file = read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles/forearm.toml");
  product.calibration.verdict = CalibrationVerdict::explained;
  return product;
}

TEST(CalibrationPage, ImpossiblePulleyIsReported) {
  formats::CalibrationProduct product = explained();
  product.correction.infeasible = "tendon 2 leaves pin D at α = 115°";
  const std::string page = formats::calibration_report_html(product);
  EXPECT_THAT(page, HasSubstr("The pulley that would correct this cannot be made: tendon 2 leaves pin D at α = 115°."));
  EXPECT_THAT(page, Not(HasSubstr("Nothing was identified")));
  EXPECT_THAT(formats::calibration_json(product), HasSubstr("\"infeasible\": \"tendon 2 leaves pin D"));
}

TEST(CalibrationPage, ReportsAssemblyAngle) {
  formats::CalibrationProduct product = explained();
  product.correction.has_pulley = true;
  product.correction.assembly_angle = radians(-1.5);
  EXPECT_THAT(formats::calibration_report_html(product), HasSubstr("the motor at -1.5 deg"));
  EXPECT_THAT(formats::calibration_json(product), HasSubstr("\"tied_at_deg\": -1.5"));
}

TEST(CalibrationPage, ReportsAdditionalMembers) {
  formats::CalibrationProduct product = explained();
  FoundEffect stretch;
  stretch.name = "tendon_stretch";
  stretch.group = {"tendon_stretch", "joint_sensor_gain"};
  product.calibration.effects = {stretch};
  EXPECT_THAT(formats::calibration_json(product), Not(HasSubstr("\"beside\"")));
  EXPECT_THAT(formats::calibration_report_html(product), Not(HasSubstr("Perhaps")));
  product.calibration.effects.front().beside = {{"joint_sensor_gain", {{"gain_percent", 1.25, 1, 1.5, 1, 1.5}}}};
  EXPECT_THAT(formats::calibration_json(product), HasSubstr("\"beside\""));
  EXPECT_THAT(
      formats::calibration_report_html(product),
      HasSubstr("Perhaps joint sensor gain (gain = 1.25 % (95 %: 1 … 1.5)) acts too: with both, as in corrected.toml"));
}

TEST(CalibrationPage, OmitsEmptyFields) {
  const std::string json = formats::calibration_json(explained());
  EXPECT_THAT(json, Not(HasSubstr("infeasible")));
  EXPECT_THAT(json, Not(HasSubstr("tied_at_deg")));
  EXPECT_THAT(formats::calibration_report_html(explained()), HasSubstr("Nothing was identified"));
}

}  // namespace
}  // namespace fusee::calibration
