// Builds of the mechanisms in profiles/: all files are checked, and a failed build leaves no file.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>

#include "fusee/pipeline.h"

namespace {

using namespace fusee;
using ::testing::Contains;
using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;
namespace fs = std::filesystem;

const fs::path k_profiles = fs::path(FUSEE_SOURCE_DIR) / "profiles";

/// The JSON without blanks and line breaks.
std::string compact(std::string json) {
  std::erase_if(json, [](char c) { return c == ' ' || c == '\n'; });
  return json;
}

class Build : public ::testing::Test {
 protected:
  Build() {
    std::string name = (fs::temp_directory_path() / "fusee-build-test-XXXXXX").string();
    scratch_ = ::mkdtemp(name.data());
    file_ = read_mechanism(k_profiles / "forearm.toml");
    options_.folder = scratch_ / "out";
  }
  ~Build() override { fs::remove_all(scratch_); }

  std::vector<std::string> names_in(const fs::path& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
    return names;
  }

  fs::path scratch_;
  MechanismFile file_;
  pipeline::BuildOptions options_;
};

std::vector<std::string> names_of(const std::vector<Check>& checks) {
  std::vector<std::string> names;
  for (const Check& check : checks) names.push_back(check.name);
  return names;
}

std::vector<std::string> names_of(const std::vector<OutputFile>& outputs) {
  std::vector<std::string> names;
  for (const OutputFile& output : outputs) names.push_back(output.name);
  return names;
}

TEST_F(Build, WritesNamedFiles) {
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  EXPECT_EQ(built.status, pipeline::BuildStatus::done);
  EXPECT_TRUE(built.published);
  EXPECT_THAT(names_in(options_.folder), ::testing::UnorderedElementsAreArray(names_of(built.outputs)));
  EXPECT_THAT(names_of(built.outputs), ::testing::IsSubsetOf(pipeline::output_names()));
  for (const OutputFile& output : built.outputs) {
    EXPECT_EQ(read_file(options_.folder / output.name, std::size_t{1} << 30), output.bytes) << output.name;
  }
}

// ---- input and settings ---------------------------------------------------------------------------------------------

const std::string& bytes_of(const pipeline::BuildResult& built, const std::string& name) {
  for (const OutputFile& output : built.outputs) {
    if (output.name == name) return output.bytes;
  }
  throw std::out_of_range("no output " + name);
}

// The file beside the meshes makes the same part: with its settings, and with a law from a table.
TEST_F(Build, MechanismBesideMeshesMakesSamePart) {
  for (const auto& [profile, settings] : {std::pair<const char*, std::vector<Setting>>{"forearm", {}},
                                          {"forearm", {{"pulley.r1_mm", "15"}}},
                                          {"gripper", {}}}) {
    SCOPED_TRACE(::testing::Message() << profile << " with " << settings.size() << " settings");
    const MechanismFile declared = read_mechanism(k_profiles / (std::string(profile) + ".toml"), settings);
    const pipeline::BuildResult first = pipeline::build(declared, options_);
    const MechanismFile kept = read_mechanism(options_.folder / "mechanism.toml");
    pipeline::BuildOptions elsewhere = options_;
    elsewhere.dry_run = true;
    const pipeline::BuildResult again = pipeline::build(kept, elsewhere);
    for (const char* name : {"pulley.stl", "pulley.obj", "pulley.drc", "profile.dxf", "transmission.csv"})
      EXPECT_EQ(bytes_of(first, name), bytes_of(again, name)) << name;
    // A file without settings and tables keeps its text, comments included.
    const bool is_unchanged = settings.empty() && profile == std::string("forearm");
    if (is_unchanged) {
      EXPECT_TRUE(kept.mechanism == declared.mechanism);
      EXPECT_EQ(bytes_of(first, "mechanism.toml"), read_file(k_profiles / "forearm.toml", 1 << 20));
    }
  }
}

TEST_F(Build, SettingsStandInManifestAndReport) {
  const MechanismFile file =
      read_mechanism(k_profiles / "forearm.toml", {{"pulley.r1_mm", "14"}, {"pulley.r1_mm", "15"}});
  const pipeline::BuildResult built = pipeline::build(file, options_);
  EXPECT_THAT(compact(bytes_of(built, "manifest.json")), HasSubstr(R"("set":{"pulley.r1_mm":15.0}})"));
  EXPECT_THAT(bytes_of(built, "report.html"), HasSubstr("forearm.toml</code> with <code>--set pulley.r1_mm=15<"));
  const pipeline::BuildResult plain = pipeline::build(file_, options_);
  EXPECT_THAT(compact(bytes_of(plain, "manifest.json")), HasSubstr(R"("set":{}})"));
  EXPECT_THAT(bytes_of(plain, "report.html"), Not(HasSubstr("--set ")));
}

TEST_F(Build, SettingsDoNotReplaceTheirFile) {
  fs::create_directories(options_.folder);
  fs::copy_file(k_profiles / "forearm.toml", options_.folder / "mechanism.toml");
  const MechanismFile file = read_mechanism(options_.folder / "mechanism.toml", {{"pulley.r1_mm", "15"}});
  options_.force = true;
  EXPECT_THROW(pipeline::build(file, options_), OutputError);
  EXPECT_EQ(read_file(options_.folder / "mechanism.toml", 1 << 20), read_file(k_profiles / "forearm.toml", 1 << 20));
}

// ---- notes and warnings ---------------------------------------------------------------------------------------------

/// "body.hub_diameter_mm" and "12" of "…; try body.hub_diameter_mm = 12 (now automatic, 8.6)".
std::optional<Setting> advised(const std::string& note) {
  const std::size_t at = note.find("; try ");
  if (at == std::string::npos) return std::nullopt;
  const std::string rest = note.substr(at + 6);
  const std::size_t equals = rest.find(" = ");
  return Setting{rest.substr(0, equals), rest.substr(equals + 3, rest.find(" (") - equals - 3)};
}

TEST_F(Build, AdvisedNumberBringsFeatureBack) {
  int tested = 0;
  for (const char* profile : {"finger", "finger_mcp", "paper_optimum"}) {
    const fs::path path = k_profiles / (std::string(profile) + ".toml");
    options_.dry_run = true;
    const pipeline::BuildResult built = pipeline::build(read_mechanism(path), options_);
    const solid::BodyLayout& layout = built.product.pulley.layout;
    for (const solid::Omission& omission : layout.omissions) {
      const std::string& note = layout.notes.at(omission.note);
      SCOPED_TRACE(std::string(profile) + ": " + note);
      const auto setting = advised(note);
      EXPECT_TRUE(setting || note.ends_with("brings it back"));
      EXPECT_THAT(note, Not(HasSubstr("which omits the set screw")));
      if (!setting) continue;
      const pipeline::BuildResult changed = pipeline::build(read_mechanism(path, {*setting}), options_);
      EXPECT_EQ(changed.status, pipeline::BuildStatus::done);
      EXPECT_FALSE(changed.product.pulley.layout.lacks(omission.feature));
      ++tested;
    }
  }
  EXPECT_GT(tested, 1);
}

// A part without home mark is mounted by another feature of its face.
TEST_F(Build, ReportNamesNoMissingMark) {
  options_.dry_run = true;
  for (const char* marks : {"engraved", "none"}) {
    const auto file = read_mechanism(k_profiles / "forearm.toml", {{"body.marks", marks}});
    const std::string report = bytes_of(pipeline::build(file, options_), "report.html");
    const bool is_marked = marks == std::string("engraved");
    EXPECT_EQ(report.find("the home mark pointing to +y") != std::string::npos, is_marked);
    EXPECT_EQ(
        report.find("knot pocket") != std::string::npos && report.find("of +y, seen from above") != std::string::npos,
        !is_marked);
  }
}

TEST_F(Build, WarnsWherePulleyMeetsAxle) {
  options_.dry_run = true;
  const auto warnings = [&](const char* ef) {
    std::vector<std::string> texts;
    const auto file = read_mechanism(k_profiles / "forearm.toml", {{"pulley.EF_mm", ef}});
    for (const Diagnostic& warning : pipeline::build(file, options_).product.file.warnings)
      if (warning.message.find("the joint's axle") != std::string::npos) texts.push_back(warning.hint);
    return texts;
  };
  const std::vector<std::string> met = warnings("40");
  ASSERT_EQ(met.size(), 1U);
  ASSERT_THAT(met[0], ::testing::StartsWith("try pulley.EF_mm = "));
  const std::size_t begin = std::string("try pulley.EF_mm = ").size();
  const std::string advised_number = met[0].substr(begin, met[0].find(" or more") - begin);
  EXPECT_THAT(warnings(advised_number.c_str()), IsEmpty());
  EXPECT_THAT(warnings("80"), IsEmpty());
}

// Cut lengths of both commands differ by what the rig's tensioner and post use, and both give that number.
TEST_F(Build, CutLengthsAgreeWithRig) {
  options_.dry_run = true;
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  pipeline::KitOptions rig;
  rig.folder = scratch_ / "kit";
  rig.dry_run = true;
  const pipeline::KitResult kit = pipeline::kit(file_, rig);
  ASSERT_TRUE(built.product.rig);
  const auto of_build = formats::rig_cuts(built.product, *built.product.rig), of_kit = formats::kit_cuts(kit.product);
  ASSERT_EQ(of_build.size(), 2U);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(of_build[i].cut, of_kit[i].cut);
    EXPECT_GT(of_build[i].longer, 0);
    EXPECT_EQ(of_build[i].longer, of_kit[i].longer);
  }
}

// ---- as one print or two --------------------------------------------------------------------------------------------

TEST_F(Build, TwoPartsAreInPrintOrientation) {
  file_.mechanism.print.parts = Parts::two;
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  EXPECT_EQ(built.status, pipeline::BuildStatus::done);
  EXPECT_THAT(names_in(options_.folder), IsSupersetOf({"pulley.stl", "pulley_p1.stl", "pulley_p2.stl"}));
  const std::string manifest = read_file(options_.folder / "manifest.json", 1 << 20);
  EXPECT_THAT(compact(manifest),
              HasSubstr(R"("print":[{"file":"pulley_p1.stl","part":"P1"},{"file":"pulley_p2.stl","part":"P2"}])"));
  // The 3mf has both parts side by side.
  const auto bodies =
      solid::bodies_of(std::get<solid::TriangleMesh>(pipeline::read_part(options_.folder / "pulley.3mf")));
  ASSERT_EQ(bodies.size(), 2u);
  double volume = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto part = std::get<solid::TriangleMesh>(
        pipeline::read_part(options_.folder / (k == 0 ? "pulley_p1.stl" : "pulley_p2.stl")));
    EXPECT_EQ(bodies[k].triangles.size(), part.triangles.size());
    EXPECT_NEAR(solid::enclosed_volume(bodies[k]), solid::enclosed_volume(part), 1e-6 * solid::enclosed_volume(part));
    EXPECT_NEAR(solid::bounds(part).low.z(), 0, 1e-5);
    volume += solid::enclosed_volume(part);
  }
  EXPECT_NEAR(
      solid::enclosed_volume(std::get<solid::TriangleMesh>(pipeline::read_part(options_.folder / "pulley.stl"))),
      volume, 1e-6 * volume);
}

TEST_F(Build, OnePartWritesNoOther) {
  file_.mechanism.print.parts = Parts::one;
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  EXPECT_EQ(built.status, pipeline::BuildStatus::done);
  EXPECT_THAT(names_in(options_.folder), Not(Contains(::testing::StartsWith("pulley_p"))));
  const std::string manifest = read_file(options_.folder / "manifest.json", 1 << 20);
  EXPECT_THAT(compact(manifest), HasSubstr(R"("print":[{"file":"pulley.stl")"));
  EXPECT_THAT(compact(manifest), Not(HasSubstr("pulley_p")));
  EXPECT_EQ(solid::bodies_of(std::get<solid::TriangleMesh>(pipeline::read_part(options_.folder / "pulley.3mf"))).size(),
            1u);
}

TEST_F(Build, OnePartRemovesEarlierParts) {
  file_.mechanism.print.parts = Parts::two;
  pipeline::build(file_, options_);
  file_.mechanism.print.parts = Parts::one;
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  EXPECT_TRUE(built.published);
  EXPECT_THAT(names_in(options_.folder), ::testing::UnorderedElementsAreArray(names_of(built.outputs)));
}

TEST_F(Build, ComparesOverhangsWithLimit) {
  file_.mechanism.print.parts = Parts::two;
  for (const double overhang : {35.0, 55.0}) {
    file_.mechanism.print.overhang = radians(overhang);
    options_.dry_run = true;
    const pipeline::BuildResult built = pipeline::build(file_, options_);
    EXPECT_EQ(built.status, pipeline::BuildStatus::done);
    for (const std::string name : {"p1_overhang", "p2_overhang"}) {
      EXPECT_THAT(built.product.checks,
                  Contains(::testing::AllOf(Field(&Check::name, name), Field(&Check::value, ::testing::Ge(overhang)),
                                            Field(&Check::limit, ::testing::DoubleNear(overhang, 0.2)))));
    }
  }
}

TEST_F(Build, SupportsAllowOverhangs) {
  for (const Parts parts : {Parts::one, Parts::two}) {
    file_.mechanism.print = {parts, radians(45), true};
    options_.dry_run = true;
    const pipeline::BuildResult built = pipeline::build(file_, options_);
    EXPECT_EQ(built.status, pipeline::BuildStatus::done);
    EXPECT_THAT(names_of(built.product.checks), Not(Contains(HasSubstr("overhang"))));
  }
}

// A slicer omits walls thinner than one line, and no check of the mesh detects that.
TEST_F(Build, WarnsOfThinWalls) {
  const auto thin_wall_warnings = [&](double nozzle) {
    file_.mechanism.print.nozzle = nozzle;
    options_.dry_run = true;
    std::vector<std::string> words;
    for (const Diagnostic& warning : pipeline::build(file_, options_).product.file.warnings) {
      if (warning.message.find("print.nozzle_mm") != std::string::npos)
        words.push_back(warning.message + " | " + warning.hint);
    }
    return words;
  };
  EXPECT_THAT(thin_wall_warnings(0.4), ::testing::IsEmpty());
  file_.mechanism.body.flange_thickness = 0.3;
  EXPECT_THAT(thin_wall_warnings(0.4), ::testing::ElementsAre(::testing::AllOf(
                                           HasSubstr("the flanges are 0.3 mm thick at the groove edge"),
                                           HasSubstr("try body.flange_thickness_mm = 0.4 or more (now 0.3)"))));
  EXPECT_THAT(thin_wall_warnings(0.25), ::testing::IsEmpty());
  file_.mechanism.body.flange_thickness = 1.2;
  file_.mechanism.body.min_wall = 0.3;
  EXPECT_THAT(thin_wall_warnings(0.4),
              ::testing::ElementsAre(::testing::AllOf(HasSubstr("0.3 mm thick"),
                                                      HasSubstr("try body.min_wall_mm = 0.4 or more (now 0.3)"))));
}

TEST_F(Build, NamesEveryCheckOnce) {
  std::vector<std::string> names = names_of(pipeline::build(file_, options_).product.checks);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

TEST_F(Build, IsReproducible) {
  const pipeline::BuildResult first = pipeline::build(file_, options_);
  options_.folder = scratch_ / "again";
  const pipeline::BuildResult second = pipeline::build(file_, options_);
  for (std::size_t i = 0; i < first.outputs.size(); ++i)
    EXPECT_EQ(first.outputs[i].bytes, second.outputs[i].bytes) << first.outputs[i].name;
}

TEST_F(Build, DryRunWritesNothing) {
  options_.dry_run = true;
  const pipeline::BuildResult dry = pipeline::build(file_, options_);
  EXPECT_FALSE(dry.published);
  EXPECT_THAT(names_in(scratch_), IsEmpty());
  options_.dry_run = false;
  EXPECT_EQ(names_of(dry.product.checks), names_of(pipeline::build(file_, options_).product.checks));
}

TEST_F(Build, StoppedBuildLeavesNothing) {
  struct Stop {};
  int steps = 0;
  pipeline::build(file_, options_, {.progress = [&steps](std::string_view, std::optional<double>) { ++steps; }});
  ASSERT_GT(steps, 5);
  fs::remove_all(options_.folder);
  for (int last = 0; last < steps; ++last) {
    const auto thrower = [left = last](std::string_view, std::optional<double>) mutable {
      if (left-- == 0) throw Stop();
    };
    EXPECT_THROW(pipeline::build(file_, options_, {.progress = thrower}), Stop);
    EXPECT_THAT(names_in(scratch_), IsEmpty()) << "stopped before step " << last;
    if (last + 1 == steps) continue;  // nothing asks after the last step
    std::stop_source source;
    const auto stopper = [&source, left = last](std::string_view, std::optional<double>) mutable {
      if (left-- == 0) source.request_stop();
    };
    EXPECT_THROW(pipeline::build(file_, options_, {.progress = stopper, .stop = source.get_token()}), Stopped);
    EXPECT_THAT(names_in(scratch_), IsEmpty()) << "asked to stop in step " << last;
  }
}

TEST_F(Build, InfeasibleDesignIsReturnedNotThrown) {
  file_.mechanism.pulley.r1 = 60;
  const pipeline::BuildResult no_curves = pipeline::build(file_, options_);
  EXPECT_EQ(no_curves.status, pipeline::BuildStatus::infeasible);
  EXPECT_THAT(no_curves.outputs, IsEmpty());
  file_ = read_mechanism(k_profiles / "forearm.toml");
  file_.mechanism.body.bore_diameter = 60;
  const pipeline::BuildResult no_body = pipeline::build(file_, options_);
  EXPECT_EQ(no_body.status, pipeline::BuildStatus::infeasible);
  EXPECT_TRUE(no_body.product.synthesis.made());
  EXPECT_THAT(names_in(scratch_), IsEmpty());
}

TEST_F(Build, FailedBuildKeepsEarlierRun) {
  options_.limits.theta_error_deg = 0;
  const pipeline::BuildResult first = pipeline::build(file_, options_);
  EXPECT_EQ(first.status, pipeline::BuildStatus::check_failed);
  EXPECT_TRUE(first.published);
  EXPECT_FALSE(pipeline::build(file_, options_).published);
  options_.force = true;
  EXPECT_TRUE(pipeline::build(file_, options_).published);
}

TEST_F(Build, PaperMethodReportsSlack) {
  file_.mechanism.pulley.method = Method::paper;
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  EXPECT_EQ(built.status, pipeline::BuildStatus::done);
  EXPECT_GT(built.product.as_built.max_excess, 0.05);
  EXPECT_THAT(names_of(built.product.checks), ::testing::AllOf(::testing::Contains("excess_length_reported"),
                                                               ::testing::Not(::testing::Contains("excess_length"))));
}

// The range requires 238.2° of the motor.
TEST_F(Build, MotorAdviceIsTriedWithFullBuild) {
  file_.mechanism.motor.travel = radians(180);
  options_.dry_run = true;
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  EXPECT_EQ(built.status, pipeline::BuildStatus::done) << "a warning unless the motor is enforced";
  const analysis::MotorCheck& motor = *built.product.under_load.motor;
  EXPECT_FALSE(motor.ok());
  ASSERT_THAT(motor.advice.alone, Not(IsEmpty()));
  EXPECT_THAT(motor.advice.alone, Contains(Field(&profile::Change::key, "pulley.r1_mm")));
  EXPECT_THAT(built.product.file.warnings, Contains(Field(&Diagnostic::message, HasSubstr("turns 180 deg"))));
  for (const profile::Change& change : motor.advice.alone) {
    if (change.key == "joint.range_deg") continue;  // both ends, by no single number
    MechanismFile changed = file_;
    find_number_key(change.key)->set(changed.mechanism, change.to);
    const pipeline::BuildResult better = pipeline::build(changed, options_);
    EXPECT_EQ(better.status, pipeline::BuildStatus::done) << change.text;
    EXPECT_TRUE(better.product.under_load.motor->ok()) << change.text;
  }
  // analyze finds the same.
  const analysis::AnalysisResult analysed = pipeline::analyze(file_);
  ASSERT_TRUE(analysed.motor);
  EXPECT_EQ(analysed.motor->travel, motor.travel);
  ASSERT_EQ(analysed.motor->advice.alone.size(), motor.advice.alone.size());
  EXPECT_EQ(analysed.motor->advice.alone.front().text, motor.advice.alone.front().text);
}

TEST_F(Build, EnforcedMotorRefusesJoint) {
  file_.mechanism.motor.travel = radians(180);
  file_.mechanism.motor.enforce = true;
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  EXPECT_EQ(built.status, pipeline::BuildStatus::infeasible);
  EXPECT_THAT(built.product.pulley.conditions, Contains(Field(&profile::Condition::name, "motor_travel")));
  EXPECT_THAT(built.advice.alone, Not(IsEmpty()));
  EXPECT_THAT(names_in(scratch_), IsEmpty());
  file_.mechanism.motor.travel = radians(300);
  EXPECT_EQ(pipeline::build(file_, options_).status, pipeline::BuildStatus::done);
}

// An infeasible pulley with an enforced motor: the advice suits both.
TEST_F(Build, AdviceOnPulleySuitsEnforcedMotor) {
  file_.mechanism.pulley.r1 = 60;
  file_.mechanism.motor.travel = radians(300);
  file_.mechanism.motor.enforce = true;
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  ASSERT_EQ(built.status, pipeline::BuildStatus::infeasible);
  for (const profile::Change& change : built.advice.alone) {
    MechanismFile changed = file_;
    find_number_key(change.key)->set(changed.mechanism, change.to);
    EXPECT_EQ(pipeline::build(changed, options_).status, pipeline::BuildStatus::done) << change.text;
  }
}

TEST_F(Build, FilesWithoutMotorDoNotMentionOne) {
  options_.dry_run = true;
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  EXPECT_FALSE(built.product.under_load.motor);
  EXPECT_THAT(built.outputs.back().bytes, Not(HasSubstr("\"motor\"")));
}

class Profiles : public Build, public ::testing::WithParamInterface<fs::path> {};

TEST_P(Profiles, PassesEveryCheck) {
  const pipeline::BuildResult built = pipeline::build(read_mechanism(GetParam()), options_);
  EXPECT_EQ(built.status, pipeline::BuildStatus::done);
  EXPECT_THAT(built.product.checks, Each(Field(&Check::ok, true)));
}

std::vector<fs::path> profiles() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(k_profiles)) {
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

INSTANTIATE_TEST_SUITE_P(Each, Profiles, ::testing::ValuesIn(profiles()),
                         [](const auto& profile) { return profile.param.stem().string(); });

// Range and torque suffice first, with a part of 167 mm. A smaller drum makes one of 106 mm.
TEST_F(Build, AdvisesDrumRadiusOfTorqueLaw) {
  const std::vector<Setting> settings{
      {"joint.length_mm", "300"}, {"load.lever_mm", "300"}, {"load.mass_kg", "1"}, {"joint.range_deg", "[-60, 60]"}};
  file_ = read_mechanism(k_profiles / "gravity_arm.toml", settings);
  options_.dry_run = true;
  const pipeline::BuildResult refused = pipeline::build(file_, options_);
  ASSERT_EQ(refused.status, pipeline::BuildStatus::infeasible);
  std::vector<std::string> keys;
  for (const profile::Change& change : refused.advice.alone) keys.push_back(change.key);
  ASSERT_THAT(keys, ::testing::ElementsAre("joint.range_deg", "pulley.motor_torque_Nmm", "joint.drum_radius_mm"));
  file_.mechanism.joint.drum_radius = refused.advice.alone.back().to;
  const pipeline::BuildResult built = pipeline::build(file_, options_);
  EXPECT_EQ(built.status, pipeline::BuildStatus::done);
  EXPECT_LT(solid::diameter_about_axis(built.product.pulley.mesh), 110.0);
}

}  // namespace
