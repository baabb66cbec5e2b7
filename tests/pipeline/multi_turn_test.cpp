// Multi-turn pulleys: builds, refusals and messages.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

#include "export/mesh_files/mesh_files.h"
#include "export/report/tendon_trace.h"
#include "fusee/base.h"
#include "fusee/export.h"
#include "fusee/helical_solid.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "fusee/transmission.h"

namespace {

using namespace fusee;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

MechanismFile read_profile(const std::string& name, const std::vector<Setting>& settings = {}) {
  return read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / (name + ".toml"), settings);
}

pipeline::BuildResult dry_build(const MechanismFile& file) {
  pipeline::BuildOptions options;
  options.folder = std::filesystem::temp_directory_path() / "fusee-multi-turn";
  options.dry_run = true;
  return pipeline::build(file, options);
}

std::string failures_of(const pipeline::BuildResult& built) {
  std::string text;
  for (const profile::Condition& condition : built.product.synthesis.conditions)
    if (!condition.ok) text += condition.message + "\n";
  for (const profile::Condition& condition : built.product.pulley.conditions)
    if (!condition.ok) text += condition.message + "\n";
  for (const Check& check : built.product.checks)
    if (!check.ok) text += check.name + " " + std::to_string(check.value) + " " + check.where + "\n";
  return text;
}

/// All messages of a successful build.
std::string words_of(const pipeline::BuildResult& built) {
  std::string text;
  for (const std::string& warning : built.product.synthesis.warnings) text += "warning: " + warning + "\n";
  for (const std::string& note : built.product.pulley.layout.notes) text += "note: " + note + "\n";
  return text;
}

std::string text_of(const pipeline::BuildResult& built, const std::string& name) {
  for (const OutputFile& output : built.outputs)
    if (output.name == name) return output.bytes;
  return "";
}

class MultiTurn : public ::testing::TestWithParam<std::string> {};

TEST_P(MultiTurn, FollowTargetMotion) {
  const pipeline::BuildResult built = dry_build(read_profile(GetParam()));
  ASSERT_EQ(built.status, pipeline::BuildStatus::done) << failures_of(built);
  ASSERT_TRUE(built.product.helix);
  EXPECT_GT(built.product.helix->synthesis.sides[0].turns, 2.5);
  EXPECT_LT(degrees(built.product.as_built.max_theta_error), 0.0005);
  EXPECT_LT(built.product.as_built.max_excess, 0.02);
  EXPECT_LT(degrees(built.product.helix->as_built.max_fleet), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Profiles, MultiTurn, ::testing::Values("wrist_turns", "elbow_capstan", "fusee_proper"),
                         [](const auto& which) { return which.param; });

/// Largest error of θ, deg, of the declared pulley on the identified joint.
double uncorrected_error(const std::string& profile, const joint::IdentifiedJoint& joint) {
  const formats::Product product = dry_build(read_profile(profile)).product;
  const std::vector<helical_solid::FloorLine> floors =
      helical_solid::helical_floors(product.pulley.mesh, product.pulley.layout.scale);
  const helical_solid::HelicalRewind wound = helical_solid::rewind_floors(
      floors.at(0), floors.at(1), joint::with_inset(joint), product.synthesis.stroke, product.helix->laid(false));
  return degrees(wound.result.max_theta_error);
}

struct IdentifiedCase {
  const char* profile;
  const char* key;
  const char* value;
  double without;  ///< least error of the declared pulley, deg; 0: not tested
};

class IdentifiedTurns : public ::testing::TestWithParam<IdentifiedCase> {};

// The corrected pulley follows the target motion on the identified joint, rewound on its mesh.
TEST_P(IdentifiedTurns, AreCorrectedByPulley) {
  const IdentifiedCase& found = GetParam();
  const pipeline::BuildResult built =
      dry_build(read_profile(found.profile, {{std::string("identified.") + found.key, found.value}}));
  ASSERT_EQ(built.status, pipeline::BuildStatus::done) << failures_of(built);
  ASSERT_TRUE(built.product.helix);
  const pipeline::BuildResult declared = dry_build(read_profile(found.profile));
  const transmission::Transmission law(declared.product.joint.mechanism);
  double error = 0;
  for (const profile::RewindPoint& point : built.product.as_built.points) {
    if (point.alpha > law.alpha_min() && point.alpha < law.alpha_max())
      error = std::max(error, std::abs(degrees(point.theta - law.theta(point.alpha))));
  }
  EXPECT_LT(error, std::string(found.key) == "profile_sin_mm" ? 0.01 : 0.001);
  if (found.without > 0) {
    EXPECT_GT(uncorrected_error(found.profile, built.product.joint), found.without);
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, IdentifiedTurns,
                         ::testing::Values(IdentifiedCase{"wrist_turns", "guide_radius_mm", "0.3", 0.01},
                                           IdentifiedCase{"wrist_turns", "guide1_outward_mm", "1", 0.05},
                                           IdentifiedCase{"wrist_turns", "length_mm", "0.5", 0.02},
                                           IdentifiedCase{"wrist_turns", "radius_offset_mm", "0.1", 0.05},
                                           IdentifiedCase{"wrist_turns", "runout_x_mm", "0.15", 0},
                                           IdentifiedCase{"wrist_turns", "profile_sin_mm", "0.1", 0},
                                           IdentifiedCase{"elbow_capstan", "drum_radius_mm", "0.3", 0.1},
                                           IdentifiedCase{"elbow_capstan", "pulley_scale_percent", "1", 0}),
                         [](const auto& which) { return std::string(which.param.profile) + "_" + which.param.key; });

/// A point of a pitch curve in profile.csv, within the range: mm, and the direction of its normal, rad, over all turns.
struct CurvePoint {
  double x = 0, y = 0, turn = 0;
  /// Distance of the tendon's line from the axis.
  double radius() const { return x * std::cos(turn) + y * std::sin(turn); }
  /// Distance of the point from the foot of the perpendicular, along the tendon's line.
  double along() const { return y * std::cos(turn) - x * std::sin(turn); }
};

std::map<std::string, std::vector<CurvePoint>> curves_in(const std::string& table) {
  std::map<std::string, std::vector<CurvePoint>> curves;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (row.at(5) != "1") continue;
    curves[row[0]].push_back({std::stod(row[2]), std::stod(row[3]), radians(std::stod(row.at(7)))});
  }
  return curves;
}

// The joint of profiles/fusee_proper.toml: a barrel and pins, with a tendon of 0.6 mm; lengths in mm, torques in N·mm.
constexpr double k_barrel = 50.0 + 0.3, k_pin = 8.0 + 0.3;         // pitch radii
constexpr double k_ED = 70.0, k_EF = 180.0;                        // the pin from the pulley's axis
constexpr double k_motor_torque = 66.6667;                         // constant
constexpr double k_spring_at_home = 400.0, k_spring_rate = 50.93;  // rate per rad

// A string runs from the barrel over a pin onto the curves in the file. The wound length gives the barrel's angle, and
// the angle gives the spring's torque. By the clockmaker's rule the chain's pull times the fusee's radius is constant.
// This holds for level strings; the slope adds 0.02 %.
TEST(ClockFusee, PullTimesRadiusIsConstant) {
  const double to_pin = std::hypot(k_ED, k_EF);
  const pipeline::BuildResult built = dry_build(read_profile("fusee_proper"));
  ASSERT_EQ(built.status, pipeline::BuildStatus::done) << failures_of(built);
  for (const auto& [pulley, curve] : curves_in(text_of(built, "profile.csv"))) {
    const double winding_sign = pulley == "P2" ? 1.0 : -1.0;
    std::vector<double> paid_out;
    double wound = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      if (i > 0) wound += std::hypot(curve[i].x - curve[i - 1].x, curve[i].y - curve[i - 1].y);
      const double out = curve[i].radius() - k_pin;
      paid_out.push_back(wound +
                         winding_sign * (std::sqrt(to_pin * to_pin - out * out) - k_pin * std::asin(out / to_pin)) -
                         curve[i].along());
    }
    const double home_radius = k_motor_torque * k_barrel / k_spring_at_home;
    const auto at_home =
        std::min_element(curve.begin(), curve.end(), [home_radius](const CurvePoint& a, const CurvePoint& b) {
          return std::abs(a.radius() - home_radius) < std::abs(b.radius() - home_radius);
        });
    const double paid_out_at_home = paid_out[static_cast<std::size_t>(at_home - curve.begin())];
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const double theta = (paid_out[i] - paid_out_at_home) / k_barrel;
      const double pull = (k_spring_at_home + k_spring_rate * theta) / k_barrel;
      ASSERT_NEAR(pull * curve[i].radius() / k_motor_torque, 1.0, 5e-4) << pulley << " at " << degrees(theta);
    }
    // The torque doubles over the barrel's 300°, and the fusee makes five turns.
    EXPECT_NEAR(std::max(curve.front().radius(), curve.back().radius()) /
                    std::min(curve.front().radius(), curve.back().radius()),
                2.0, 1e-3);
    EXPECT_NEAR(std::abs(curve.back().turn - curve.front().turn) / k_two_pi, 5.0, 0.02);
  }
}

// The work that turns the wound mesh equals the energy in the spring: 66.67 α = 400 θ + 50.93 θ²/2.
TEST(ClockFusee, SpringStoresWork) {
  const pipeline::BuildResult built = dry_build(read_profile("fusee_proper"));
  ASSERT_EQ(built.status, pipeline::BuildStatus::done) << failures_of(built);
  ASSERT_GT(built.product.as_built.points.size(), 50U);
  for (const profile::RewindPoint& point : built.product.as_built.points) {
    const double theta =
        (std::sqrt(k_spring_at_home * k_spring_at_home + 2.0 * k_spring_rate * k_motor_torque * point.alpha) -
         k_spring_at_home) /
        k_spring_rate;
    EXPECT_NEAR(degrees(point.theta), degrees(theta), 0.0005) << degrees(point.alpha);
  }
}

TEST(MultiTurnFiles, ListHelicalCurves) {
  const pipeline::BuildResult built = dry_build(read_profile("wrist_turns"));
  ASSERT_EQ(built.status, pipeline::BuildStatus::done) << failures_of(built);
  std::istringstream profile(text_of(built, "profile.csv"));
  std::string header, row;
  std::getline(profile, header);
  EXPECT_THAT(header, HasSubstr("normal_deg,turn_deg,z_mm"));
  std::getline(profile, row);
  EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
  EXPECT_THAT(text_of(built, "transmission.csv"), HasSubstr("slope1_deg,fleet1_deg,slope2_deg,fleet2_deg"));
  EXPECT_THAT(text_of(built, "manifest.json"), HasSubstr("joint_end_z_mm"));
  EXPECT_THAT(text_of(built, "report.html"), HasSubstr("wound several times"));
  EXPECT_THAT(text_of(built, "report.html"), HasSubstr("<h2>The tendons in motion</h2>"));
  EXPECT_EQ(text_of(built, "plates.dxf"), "");
  EXPECT_THAT(built.product.pulley.layout.notes, Contains(HasSubstr("there is no plates.dxf")));
}

// Both polylines of each groove as another program reads them: turns of the working arc, and height from end to end.
TEST(MultiTurnFiles, DrawSpiralsInSpace) {
  for (const formats::DxfVersion version : {formats::DxfVersion::ac1015, formats::DxfVersion::r12}) {
    pipeline::BuildOptions options;
    options.folder = std::filesystem::temp_directory_path() / "fusee-multi-turn";
    options.dry_run = true;
    options.dxf = version;
    const pipeline::BuildResult built = pipeline::build(read_profile("elbow_capstan"), options);
    ASSERT_EQ(built.status, pipeline::BuildStatus::done) << failures_of(built);
    const formats::Drawing drawing = formats::read_dxf(text_of(built, "profile.dxf"), "profile.dxf");
    for (const std::string layer : {"P1_SPIRAL", "P2_SPIRAL"}) {
      const auto path = std::find_if(drawing.paths.begin(), drawing.paths.end(),
                                     [&](const formats::DrawingPath& one) { return one.layer == layer; });
      ASSERT_NE(path, drawing.paths.end()) << layer;
      EXPECT_TRUE(path->in_space);
      double turned = 0;
      for (std::size_t i = 1; i < path->points.size(); ++i) {
        const Vec2 &a = path->points[i - 1], &b = path->points[i];
        EXPECT_NEAR(b.norm(), 7.0, 1e-6);
        turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
      }
      // The joint turns by 110°, on a drum of 90.3 mm pitch radius, and the pulley of 7 mm turns 12.9 times as far.
      EXPECT_NEAR(std::abs(degrees(turned)), 110.0 * 12.9, 1.0) << layer;
    }
  }
}

TEST(MultiTurnFiles, ScadHasBothGrooves) {
  const pipeline::BuildResult built = dry_build(read_profile("fusee_proper"));
  const std::string program = text_of(built, "pulley.scad");
  for (const char* has :
       {"\nedge_bulges1 = [", "\nP1 = [", "\nP2 = [", "module run_out", "module bore_hole", "module screw_hole"})
    EXPECT_THAT(program, HasSubstr(has));
  for (const char* none : {"module channel", "//= ", "face_holes"}) EXPECT_THAT(program, Not(HasSubstr(none)));
}

// The ceilings of channels slope by at least 57.5° (k_flattest_peak in run_out.cpp), also for printers that can print
// flatter ones.
TEST(MultiTurnPrint, FitEveryPrinter) {
  for (const char* profile : {"wrist_turns", "elbow_capstan"}) {
    for (const char* overhang : {"20", "35", "60", "70"})
      EXPECT_EQ(dry_build(read_profile(profile, {{"print.overhang_deg", overhang}})).status,
                pipeline::BuildStatus::done)
          << profile << " at " << overhang;
    EXPECT_EQ(dry_build(read_profile(profile, {{"print.supports", "true"}})).status, pipeline::BuildStatus::done)
        << profile;
  }
}

// At a slope of 4.68° tensions grow by 1/cos, and their stretch by 1/cos³.
TEST(MultiTurnWords, NoteErrorOfLevelTendons) {
  const auto note_of = [](const std::vector<Setting>& settings) {
    std::string text;
    for (const Diagnostic& one : pipeline::analyze(read_profile("wrist_turns", settings)).warnings) text += one.message;
    return text;
  };
  EXPECT_THAT(note_of({}),
              HasSubstr("slope by up to 4.68°, which increases tensions by up to 0.34 % and their stretch by "
                        "up to 1 %"));
}

TEST(MultiTurnWords, NameReasonForOneTurn) {
  EXPECT_THAT(failures_of(dry_build(read_profile("wrist_turns", {{"pulley.winding", "one_turn"}}))),
              HasSubstr("more than one turn (pulley.winding = \"one_turn\")"));
}

TEST(MultiTurnWords, ReportUnusedKeys) {
  const auto words_with = [](const char* profile, const std::vector<Setting>& settings) {
    std::string text;
    for (const Diagnostic& one : dry_build(read_profile(profile, settings)).product.file.warnings)
      text += one.message + "\n";
    return text;
  };
  const std::vector<Setting> all{{"guides.collar", "true"}, {"body.lead_mm", "3"}, {"body.spare_turns", "2"}};
  const std::string of_one = words_with("paper_optimum", all), silent = words_with("paper_optimum", {}),
                    of_many = words_with("wrist_turns", all);
  for (const char* key : {"guides.collar", "body.lead_mm", "body.spare_turns"}) {
    EXPECT_THAT(of_one, HasSubstr(std::string(key) + " is not used"));
    EXPECT_THAT(silent, Not(HasSubstr(key)));
    EXPECT_THAT(of_many, Not(HasSubstr(key)));
  }
}

/// The message gives the required number of turns, and a value that builds.
TEST(MultiTurnWords, ReportTooManyTurns) {
  const std::vector<Setting> many{{"pulley.r1_mm", "1.2"}};
  const pipeline::BuildResult built = dry_build(read_profile("elbow_capstan", many));
  ASSERT_EQ(built.status, pipeline::BuildStatus::infeasible);
  EXPECT_THAT(failures_of(built),
              HasSubstr("P1 would wind 23 turns over the range: at most 12 are supported, 52 % of this"));
  ASSERT_FALSE(built.advice.alone.empty());
  const profile::Change& change = built.advice.alone.front();
  EXPECT_EQ(change.key, "pulley.r1_mm");
  EXPECT_EQ(dry_build(read_profile("elbow_capstan", {{"pulley.r1_mm", std::to_string(change.to)}})).status,
            pipeline::BuildStatus::done);
}

/// Multi-turn pulleys have no marks and no plates.dxf. Notes report it, whatever the file requests.
TEST(MultiTurnWords, ListOmittedFeatures) {
  for (const char* marks : {"engraved", "raised"}) {
    const pipeline::BuildResult built = dry_build(read_profile("wrist_turns", {{"body.marks", marks}}));
    ASSERT_EQ(built.status, pipeline::BuildStatus::done) << failures_of(built);
    for (const std::string& text : {words_of(built), text_of(built, "manifest.json")}) {
      EXPECT_THAT(text, HasSubstr("multi-turn pulleys have no marks and no slots for the tails"));
      EXPECT_THAT(text, HasSubstr("there is no plates.dxf: plates cannot have helical grooves"));
    }
    EXPECT_EQ(text_of(built, "plates.dxf"), "");
  }
}

/// This joint has no other obstacle: it builds with a smaller ratio, and there is advice.
TEST(MultiTurnWords, SheathsAdviseRatio) {
  const pipeline::BuildResult built = dry_build(read_profile("wrist_sheath", {{"pulley.ratio", "13"}}));
  ASSERT_EQ(built.status, pipeline::BuildStatus::infeasible);
  EXPECT_THAT(failures_of(built),
              HasSubstr("more than one turn (a tendon out of a sheath is not wound several times yet)"));
  EXPECT_FALSE(built.advice.empty());
  EXPECT_EQ(dry_build(read_profile("wrist_sheath", {{"pulley.ratio", "4.55"}})).status, pipeline::BuildStatus::done);
}

TEST(MultiTurnWords, RejectSmallLeadWithAdvice) {
  const pipeline::BuildResult built = dry_build(read_profile("wrist_turns", {{"body.lead_mm", "1.2"}}));
  ASSERT_EQ(built.status, pipeline::BuildStatus::infeasible);
  EXPECT_THAT(failures_of(built), HasSubstr("is too small"));
  EXPECT_FALSE(built.advice.empty());
}

std::vector<Setting> with_collars(double ef, double lead) {
  return {{"guides.collar", "true"}, {"pulley.EF_mm", std::to_string(ef)}, {"body.lead_mm", std::to_string(lead)}};
}

/// Without collars there is no fleet angle; with them the pulley's distance and the lead determine it.
TEST(FleetAngles, GrowingAnglesAreReported) {
  const pipeline::BuildResult none = dry_build(read_profile("wrist_turns"));
  EXPECT_THAT(words_of(none), Not(HasSubstr("fleet angle of")));
  const pipeline::BuildResult small = dry_build(read_profile("wrist_turns", with_collars(300, 0)));
  ASSERT_EQ(small.status, pipeline::BuildStatus::done) << failures_of(small);
  EXPECT_THAT(words_of(small), Not(HasSubstr("fleet angle of")));
  EXPECT_THAT(words_of(small), Not(HasSubstr("leaves its groove")));
  const pipeline::BuildResult noted = dry_build(read_profile("wrist_turns", with_collars(170, 0)));
  ASSERT_EQ(noted.status, pipeline::BuildStatus::done) << failures_of(noted);
  EXPECT_THAT(words_of(noted), HasSubstr("note: a fleet angle of 1.95° exceeds the 1.5° limit of smooth drums"));
  EXPECT_THAT(words_of(noted), Not(HasSubstr("leaves its groove")));
  const pipeline::BuildResult warned = dry_build(read_profile("wrist_turns", with_collars(60, 7)));
  ASSERT_EQ(warned.status, pipeline::BuildStatus::done) << failures_of(warned);
  EXPECT_THAT(words_of(warned), HasSubstr("warning: tendon 1 leaves its groove at a fleet angle of up to 5.57° (α"));
  EXPECT_THAT(words_of(warned), Not(HasSubstr("note: a fleet angle of")));
}

/// The default lower wall leans by 25°, at a largest radius of 10.2 mm and 1 mm deep: tan 25° √(1/20.4) is 5.9°. The
/// seat is slightly wider than the tendon, which adds 0.24°.
TEST(FleetAngles, LargeAnglesAreRefusedWithAdvice) {
  const pipeline::BuildResult built = dry_build(read_profile("wrist_turns", with_collars(60, 8)));
  ASSERT_EQ(built.status, pipeline::BuildStatus::infeasible);
  EXPECT_THAT(failures_of(built), HasSubstr("tendon 1 leaves its groove at a fleet angle of 6.29° at α = "));
  EXPECT_THAT(failures_of(built), HasSubstr("above 6.14° it touches the groove edge"));
  ASSERT_FALSE(built.advice.alone.empty());
  for (const profile::Change& change : built.advice.alone) {
    std::vector<Setting> mended = with_collars(60, 8);
    mended.push_back({change.key, std::to_string(change.to)});
    EXPECT_EQ(dry_build(read_profile("wrist_turns", mended)).status, pipeline::BuildStatus::done) << change.text;
  }
}

/// Equal tendons and places: steep walls allow smaller angles than leaning ones.
TEST(FleetAngles, LeaningGroovesAllowLargerAngles) {
  std::vector<Setting> steep = with_collars(60, 0), leaning = with_collars(60, 8);
  steep.push_back({"body.groove_angle_deg", "5"});
  leaning.push_back({"body.groove_angle_deg", "80"});
  EXPECT_THAT(failures_of(dry_build(read_profile("wrist_turns", steep))),
              HasSubstr("above 0.921° it touches the groove edge"));
  EXPECT_EQ(dry_build(read_profile("wrist_turns", leaning)).status, pipeline::BuildStatus::done);
}

/// The number that the refusal of a body advises builds.
TEST(MultiTurnWords, BodyAdviceBuilds) {
  const std::vector<Setting> pocket{{"tendon.diameter_mm", "1.07"}, {"body.knot_pocket_mm", "7"}};
  const pipeline::BuildResult built = dry_build(read_profile("elbow_capstan", pocket));
  ASSERT_EQ(built.status, pipeline::BuildStatus::infeasible);
  EXPECT_THAT(failures_of(built), HasSubstr("knot pocket"));
  const auto change = std::find_if(built.advice.alone.begin(), built.advice.alone.end(),
                                   [](const profile::Change& one) { return one.key == "body.knot_pocket_mm"; });
  ASSERT_NE(change, built.advice.alone.end());
  std::vector<Setting> mended = pocket;
  mended.back().value = std::to_string(change->to);
  EXPECT_EQ(dry_build(read_profile("elbow_capstan", mended)).status, pipeline::BuildStatus::done);
}

/// Regressions: each of these bodies once intersected itself or broke through its rim.
TEST(MultiTurnBodies, PassRegressions) {
  const std::vector<std::vector<Setting>> designs{
      {{"tendon.diameter_mm", "0.72"}, {"pulley.r1_mm", "6.61"}, {"body.spare_turns", "1.7"}},
      {{"tendon.diameter_mm", "0.9"}, {"body.anchor_hole_mm", "2"}}};
  for (const std::vector<Setting>& settings : designs) {
    const pipeline::BuildResult built = dry_build(read_profile("elbow_capstan", settings));
    EXPECT_EQ(built.status, pipeline::BuildStatus::done) << settings.front().value << "\n" << failures_of(built);
  }
  // Turns of the same normal are far apart in plan.
  const pipeline::BuildResult aside = dry_build(read_profile("wrist_turns", {{"pulley.ratio", "6.71"},
                                                                             {"joint.length_mm", "246.3"},
                                                                             {"guides.EB_mm", "136.6"},
                                                                             {"guides.ED_mm", "159.3"},
                                                                             {"pulley.EF_mm", "162.2"},
                                                                             {"joint.range_deg", "[-35.3, 29.7]"},
                                                                             {"body.groove", "u"}}));
  EXPECT_EQ(aside.status, pipeline::BuildStatus::done) << failures_of(aside);
}

TEST(MultiTurnWords, RejectWideHub) {
  const pipeline::BuildResult wide = dry_build(read_profile("wrist_turns", {{"body.hub_diameter_mm", "90"}}));
  EXPECT_EQ(wide.status, pipeline::BuildStatus::infeasible);
  EXPECT_THAT(failures_of(wide), HasSubstr("the upper flange has space for a hub of"));
  const pipeline::BuildResult thin = dry_build(read_profile("wrist_turns", {{"body.hub_diameter_mm", "2"}}));
  EXPECT_EQ(thin.status, pipeline::BuildStatus::infeasible);
  EXPECT_THAT(failures_of(thin), HasSubstr("body.hub_diameter_mm) leaves"));
}

// ---- rewinding of files

/// Each mesh file of a build, of a shrinking material printed larger, gives the error that the build reports.
TEST_P(MultiTurn, RewindOnFiles) {
  const MechanismFile file = read_profile(GetParam(), {{"material.shrinkage_percent", "0.8"}});
  const pipeline::BuildResult built = dry_build(file);
  ASSERT_EQ(built.status, pipeline::BuildStatus::done) << failures_of(built);
  for (const char* name : {"pulley.stl", "pulley.3mf", "pulley.drc"}) {
    const solid::TriangleMesh mesh = formats::read_mesh(text_of(built, name), name);
    const pipeline::RewoundPart wound = pipeline::rewind_moved_part(joint::identified_joint(file.mechanism), mesh);
    EXPECT_EQ(wound.place, pipeline::PartPlace::as_made) << name;
    EXPECT_LT(degrees(wound.as_built.max_theta_error), 0.0005) << name;
    EXPECT_EQ(wound.as_built.points.size(), built.product.as_built.points.size());
    solid::TriangleMesh moved = mesh;
    for (Vec3& vertex : moved.vertices) vertex.x() += 0.2;
    EXPECT_GT(degrees(pipeline::rewind_part(joint::identified_joint(file.mechanism), moved).max_theta_error), 0.01)
        << name;
  }
}

TEST(MultiTurnWords, RejectDrawing) {
  try {
    pipeline::rewind_part(joint::identified_joint(read_profile("wrist_turns").mechanism), formats::Drawing{});
    FAIL() << "rewound on a drawing";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("pulley.stl"));
  }
}

// ---- the kit

/// One turn of the spiral around the row `turn`, as a plane curve.
profile::Outline turn_about(const helix::Spiral& spiral, transmission::Side side, double turn) {
  profile::Outline outline;
  outline.side = side;
  for (const helix::SpiralRow& row : spiral.rows) {
    if (std::abs(row.turn - turn) < k_pi)
      outline.points.push_back({row.turn, Vec2(row.x, row.y), unit(row.turn), row.rho});
  }
  outline.active_last = outline.points.size() - 1;
  return outline;
}

/// A tendon at one place of the stroke, by tangents to the drawing: from its end on the joint to the row it leaves.
struct TracedTendon {
  formats::TendonTrace trace;
  std::size_t row = 0;
};
TracedTendon trace_to_row(const formats::Product& product, transmission::Side side, std::size_t place) {
  const helix::HelixSide& helix = product.helix->synthesis.sides.at(side == transmission::Side::left ? 0 : 1);
  const double z = helix.stroke.at(place).z;
  std::size_t near = 0;
  for (std::size_t i = 0; i < helix.spiral.rows.size(); ++i)
    if (std::abs(helix.spiral.rows[i].z - z) < std::abs(helix.spiral.rows[near].z - z)) near = i;
  const transmission::TransmissionPoint& at = product.synthesis.stroke.at(place);
  const auto trace = formats::trace_tendon(
      product.joint.mechanism, turn_about(helix.spiral, side, helix.spiral.rows[near].turn), at.alpha, at.theta);
  EXPECT_TRUE(trace.has_value());
  const Vec2 take_off = turned(trace->take_off - formats::pulley_axis(product.joint.mechanism), at.alpha);
  std::size_t row = near;
  double nearest = 1e9;
  for (std::size_t i = 0; i < helix.spiral.rows.size(); ++i) {
    const helix::SpiralRow& candidate = helix.spiral.rows[i];
    const double distance = std::hypot(candidate.x - take_off.x(), candidate.y - take_off.y());
    if (std::abs(candidate.turn - helix.spiral.rows[near].turn) > 3.0 || distance >= nearest) continue;
    nearest = distance;
    row = i;
  }
  return {*trace, row};
}

/// Length of the path up to its point `last`.
double length_to(const std::vector<Vec2>& path, std::size_t last) {
  double length = 0;
  for (std::size_t i = 0; i < last; ++i) length += (path[i + 1] - path[i]).norm();
  return length;
}

class MultiTurnKit : public ::testing::TestWithParam<std::string> {
 protected:
  static pipeline::KitResult made_kit() {
    pipeline::KitOptions options;
    options.folder = std::filesystem::temp_directory_path() / "fusee-multi-turn-kit";
    options.dry_run = true;
    return pipeline::kit(read_profile(GetParam()), options);
  }
};

/// Cut length from knot to knot: along the drawn path in plan with its rise, along the rows in space, and to the
/// pocket.
TEST_P(MultiTurnKit, CutLengthMatchesWoundLength) {
  const pipeline::KitResult made = made_kit();
  ASSERT_EQ(made.ending, pipeline::KitEnding::done);
  const formats::Product& product = made.product.pulley;
  const auto& stroke = product.synthesis.stroke;
  std::size_t home = 0;
  for (std::size_t i = 0; i < stroke.size(); ++i)
    if (std::abs(stroke[i].alpha) < std::abs(stroke[home].alpha)) home = i;
  const std::vector<formats::KitCut> cuts = formats::kit_cuts(made.product);
  ASSERT_EQ(cuts.size(), 2u);
  for (const formats::KitCut& cut : cuts) {
    const helix::HelixSide& side = product.helix->synthesis.sides.at(cut.side == transmission::Side::left ? 0 : 1);
    const std::vector<helix::SpiralRow>& rows = side.spiral.rows;
    const auto [trace, row] = trace_to_row(product, cut.side, home);
    double length = std::hypot(trace.free_length, rows[row].z - side.attachment_z);
    const std::size_t end = cut.side == transmission::Side::left ? rows.size() - 1 : 0;
    for (std::size_t i = std::min(row, end); i < std::max(row, end); ++i)
      length += Vec3(rows[i + 1].x - rows[i].x, rows[i + 1].y - rows[i].y, rows[i + 1].z - rows[i].z).norm();
    for (const helical_solid::HelicalAnchor& anchor : product.helix->pulley.anchors)
      if (anchor.side == cut.side) length += (anchor.pocket - anchor.exit).norm();
    EXPECT_NEAR(cut.between_knots, length, 0.05) << GetParam();
    EXPECT_GT(cut.cut, cut.between_knots + 100);
  }
}

/// A tendon rises evenly over drum and pins, and reaches each of the given heights once.
TEST_P(MultiTurnKit, ReportsTendonHeights) {
  const pipeline::KitResult made = made_kit();
  ASSERT_TRUE(made.product.plan.heights);
  const kit::TendonHeights& heights = *made.product.plan.heights;
  const formats::Product& product = made.product.pulley;
  kit::TendonHeights::Span on_drum;
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const std::size_t i = side == transmission::Side::left ? 0 : 1;
    const helix::HelixSide& helix = product.helix->synthesis.sides.at(i);
    const helical_solid::SpiralPlace& spiral_place = i == 0 ? product.helix->pulley.p1 : product.helix->pulley.p2;
    const double end = spiral_place.height(helix.attachment_z);
    EXPECT_NEAR(heights.ends.at(i), end, 1e-9);
    on_drum.include(end);
    kit::TendonHeights::Span on_guide;
    for (std::size_t k = 0; k < product.synthesis.stroke.size(); k += 5) {
      const auto [trace, row] = trace_to_row(product, side, k);
      const double take_off = spiral_place.height(helix.spiral.rows[row].z);
      const auto height = [&, &path = trace.free_path](std::size_t point) {
        return end + (take_off - end) * length_to(path, point) / length_to(path, path.size() - 1);
      };
      for (std::size_t point = 0; point < trace.free_path.size(); ++point) {
        const Vec2 at = trace.free_path[point];
        if ((at - formats::pin_centre(product.joint.mechanism, side)).norm() <
            product.joint.mechanism.guide_pitch_radius() + 1e-6)
          on_guide.include(height(point));
        if (at.norm() < product.joint.mechanism.joint.drum_radius + product.joint.mechanism.tendon.diameter)
          on_drum.include(height(point));
      }
    }
    EXPECT_NEAR(on_guide.low, heights.guides.at(i).low, 0.1) << GetParam();
    EXPECT_NEAR(on_guide.high, heights.guides.at(i).high, 0.1) << GetParam();
  }
  EXPECT_NEAR(on_drum.low, heights.drum.low, 0.1) << GetParam();
  EXPECT_NEAR(on_drum.high, heights.drum.high, 0.1) << GetParam();
  for (const kit::KitPart& part : made.product.plan.parts) {
    if (part.name != "drum") continue;
    const solid::Bounds box = solid::bounds(kit::mesh_of(part.body));
    EXPECT_NEAR(box.high.z() - box.low.z(),
                heights.drum.high - heights.drum.low + 2 * (product.joint.mechanism.tendon.diameter + 1), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, MultiTurnKit, ::testing::Values("wrist_turns", "elbow_capstan", "fusee_proper"),
                         [](const auto& which) { return which.param; });

/// A printer that requires slopes of 55° gets steeper chamfers at the bed.
TEST(MultiTurnKitWords, PartsFollowOverhangLimit) {
  pipeline::KitOptions options;
  options.folder = std::filesystem::temp_directory_path() / "fusee-multi-turn-kit";
  options.dry_run = true;
  const pipeline::KitResult made =
      pipeline::kit(read_profile("elbow_capstan", {{"print.overhang_deg", "55"}}), options);
  for (const Check& check : made.product.checks) EXPECT_TRUE(check.ok) << check.name << " " << check.value;
  EXPECT_EQ(made.ending, pipeline::KitEnding::done);
}

/// The refusal names the obstacle and tested changes.
TEST(MultiTurnKitWords, AdviceRemovesObstacle) {
  pipeline::KitOptions options;
  options.folder = std::filesystem::temp_directory_path() / "fusee-multi-turn-kit";
  options.dry_run = true;
  const pipeline::KitResult refused =
      pipeline::kit(read_profile("wrist_turns", {{"guides.radius_mm", "0.2"}}), options);
  EXPECT_EQ(refused.ending, pipeline::KitEnding::no_kit);
  ASSERT_FALSE(refused.advice.alone.empty());
  EXPECT_EQ(refused.advice.alone.front().key, "guides.radius_mm");
}

}  // namespace
