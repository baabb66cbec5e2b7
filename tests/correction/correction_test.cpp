#include "fusee/correction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/text.h"
#include "fusee/joint.h"
#include "fusee/mechanism_file.h"
#include "fusee/profile.h"
#include "fusee/transmission.h"
#include "support/mechanisms.h"

namespace fusee::correction {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* k_declared = R"(# my joint
schema = 1
name = "forearm"  # mine
[joint]
length_mm = 100
range_deg = [-30, 30]
[guides]
EB_mm = 50
ED_mm = 50
OE_mm = -40
radius_mm = 2  # by caliper
[pulley]
EF_mm = 80
r1_mm = 16
[tendon]
diameter_mm = 1
)";

DeclaredMechanism declared() { return parse_mechanism(k_declared, "forearm.toml"); }
DeclaredMechanism frictionless() {
  DeclaredMechanism mechanism = declared();
  mechanism.guides.mu = 0;
  return mechanism;
}

/// Largest deviation from the law of `wanted`, rad, of a joint with the true geometry `truth` and a pulley drawn for
/// `made_for`. Tendons are wound on its outline, scaled by `scale`, `offset` further out and moved by `runout`, both
/// mm.
double law_error(const Mechanism& wanted, const Mechanism& truth, const joint::IdentifiedJoint& made_for,
                 double scale = 1, double offset = 0, const Vec2& runout = {0, 0}) {
  const Mechanism& drawn = made_for.mechanism;
  profile::SynthesisOptions options;
  options.chord_error_mm = 0.001;
  profile::SynthesisResult made = profile::synthesise(drawn, options);
  if (!made.made()) return std::numeric_limits<double>::quiet_NaN();
  joint::draw_for_making(made, made_for.outline);
  const double printed = scale / (1 - drawn.material.shrinkage);
  const auto floor = [&](const profile::Outline& outline) {
    Polygon polygon = profile::parallel(outline, -0.5 * drawn.tendon.diameter);
    for (Vec2& point : polygon) point = printed * point + runout;
    return polygon;
  };
  // A uniform offset is equivalent to a thicker tendon over thinner pins.
  Mechanism joint = truth;
  joint.tendon.diameter += 2 * offset;
  joint.guides.radius -= offset;
  joint.pulley = wanted.pulley;
  joint.joint.theta_min = wanted.joint.theta_min;
  const transmission::Transmission law(wanted);
  double worst = 0;
  for (const profile::RewindPoint& point : profile::rewind(joint, floor(made.p1), floor(made.p2)).points) {
    if (point.alpha < law.alpha_min() || point.alpha > law.alpha_max()) continue;
    worst = std::max(worst, std::abs(point.theta - law.theta(point.alpha)));
  }
  return worst;
}

TEST(IdentifiedJoint, IsDeclaredWithoutIdentification) {
  EXPECT_EQ(joint::identified_joint(declared()).mechanism, static_cast<const Mechanism&>(declared()));
  EXPECT_EQ(joint::identified_joint(declared()).outline, OutlineError{});
  DeclaredMechanism backlash = declared();
  backlash.identified.shaft.backlash = 0.1;
  backlash.identified.sensor.lag = 0.1;
  EXPECT_EQ(joint::identified_joint(backlash).mechanism.pulley, declared().pulley);
}

TEST(IdentifiedJoint, IsExpectedByNextCalibration) {
  DeclaredMechanism mechanism = declared();
  mechanism.identified.pins.radius = 1.5;
  mechanism.identified.pulley.outline.runout_x = 0.1;
  const DeclaredMechanism expected = joint::expected_joint(mechanism);
  EXPECT_EQ(static_cast<const Mechanism&>(expected), joint::identified_joint(mechanism).mechanism);
  EXPECT_EQ(expected.identified, Imperfections{});
  EXPECT_EQ(joint::expected_joint(expected), expected);
}

// The brief search is used for hundreds of candidate mechanisms: it is close to the full search, and equal without
// compliance.
TEST(IdentifiedJoint, BriefSearchIsCloseToFull) {
  DeclaredMechanism mechanism = declared();
  mechanism.load.tip_force = 15.0;
  mechanism.identified.tendon.stretch = 12.0;
  mechanism.identified.joint.mean_load = 4.0;
  const Mechanism whole = joint::identified_joint(mechanism).mechanism,
                  brief = joint::identified_joint(mechanism, joint::LawSearch::brief).mechanism;
  EXPECT_EQ(brief.pulley.law, whole.pulley.law);
  EXPECT_LT(2 * brief.pulley.rows.size(), whole.pulley.rows.size());
  const transmission::Transmission law(whole), near(brief);
  double moved = 0, apart = 0;
  for (double alpha = law.alpha_min(); alpha <= law.alpha_max(); alpha += radians(5.0)) {
    moved = std::max(moved, std::abs(law.theta(alpha) - transmission::Transmission(declared()).theta(alpha)));
    apart = std::max(apart, std::abs(law.theta(alpha) - near.theta(alpha)));
  }
  EXPECT_GT(degrees(moved), 0.5);
  EXPECT_LT(degrees(apart), 0.1);
  mechanism.identified = {};
  mechanism.identified.pins.radius = 2.0;
  EXPECT_EQ(joint::identified_joint(mechanism, joint::LawSearch::brief).mechanism.joint,
            joint::identified_joint(mechanism).mechanism.joint);
}

TEST(IdentifiedJoint, CorrectsGuideRadius) {
  DeclaredMechanism mechanism = declared();
  mechanism.identified.pins.radius = 2.0;
  DeclaredMechanism truth = declared();
  truth.guides.radius += 2.0;
  const double before = law_error(declared(), truth, joint::identified_joint(declared()));
  EXPECT_GT(degrees(before), 0.2);
  EXPECT_LT(degrees(law_error(declared(), truth, joint::identified_joint(mechanism))), 0.03);
}

TEST(IdentifiedJoint, CorrectsLength) {
  DeclaredMechanism mechanism = declared();
  mechanism.identified.joint.length = 2.0;
  DeclaredMechanism truth = declared();
  truth.joint.R += 2.0;
  const double before = law_error(declared(), truth, joint::identified_joint(declared()));
  EXPECT_LT(law_error(declared(), truth, joint::identified_joint(mechanism)), 0.1 * before);
}

TEST(IdentifiedJoint, CorrectsPulleyOffset) {
  for (const double offset : {0.2, -0.3}) {
    DeclaredMechanism mechanism = declared();
    mechanism.identified.pulley.outline.offset = offset;
    const double before = law_error(declared(), declared(), joint::identified_joint(declared()), 1, offset);
    EXPECT_GT(degrees(before), 0.2);
    EXPECT_LT(law_error(declared(), declared(), joint::identified_joint(mechanism), 1, offset), 0.05 * before);
    // Grooves, anchors and holes are those of the actual tendon.
    EXPECT_EQ(joint::identified_joint(mechanism).mechanism.tendon, declared().tendon);
  }
}

TEST(IdentifiedJoint, CorrectsPulleyScale) {
  DeclaredMechanism mechanism = declared();
  mechanism.identified.pulley.scale = -0.02;
  const double before = law_error(declared(), declared(), joint::identified_joint(declared()), 0.98);
  EXPECT_LT(law_error(declared(), declared(), joint::identified_joint(mechanism), 0.98), 0.05 * before);
}

TEST(IdentifiedJoint, CorrectsRunout) {
  DeclaredMechanism mechanism = declared();
  mechanism.identified.pulley.outline.runout_x = 0.3;
  mechanism.identified.pulley.outline.runout_y = -0.2;
  const double before = law_error(declared(), declared(), joint::identified_joint(declared()), 1, 0, {0.3, -0.2});
  EXPECT_LT(law_error(declared(), declared(), joint::identified_joint(mechanism), 1, 0, {0.3, -0.2}), 0.05 * before);
}

TEST(RoundChoice, StaysRoundIfSufficient) {
  DeclaredMechanism mechanism = declared();
  EXPECT_TRUE(joint::round_choice(mechanism).suffices);
  EXPECT_NEAR(joint::round_choice(mechanism).r1, 16, 1e-3);
  mechanism.identified.pins.left.outward = mechanism.identified.pins.right.outward = 5;
  EXPECT_FALSE(joint::round_choice(mechanism).suffices);
  EXPECT_GT(degrees(joint::round_choice(mechanism).max_error), 0.005);
}

calibration::Calibration found_guide_radius() {
  calibration::Calibration calibration;
  calibration.verdict = calibration::CalibrationVerdict::explained;
  calibration::FoundEffect effect;
  effect.name = "guide_radius";
  effect.place = ChainPlace::pins;
  effect.group = {"guide_radius"};
  effect.parameters = {{"radius_mm", 3.5, 3.4, 3.6}};
  calibration.effects = {effect};
  calibration.identified.pins.radius = 1.5;
  return calibration;
}

TEST(CorrectedToml, KeepsFileAndAddsIdentified) {
  Correction correction;
  correction.identified = found_guide_radius().identified;
  const std::string text = corrected_toml(k_declared, declared(), found_guide_radius(), correction);
  EXPECT_THAT(text, HasSubstr("# my joint\n"));
  EXPECT_THAT(text, HasSubstr("radius_mm = 2  # by caliper\n"));
  EXPECT_THAT(text, HasSubstr("\nguide_radius_mm = 1.5\n"));
  EXPECT_EQ(text.substr(0, text.find("\n[identified]")), k_declared);
  EXPECT_THAT(text, HasSubstr("# guide_radius (pins): radius_mm = 3.5"));
  DeclaredMechanism read = parse_mechanism(text, "corrected.toml");
  EXPECT_EQ(read.identified.pins.radius, 1.5);
  read.identified = {};
  EXPECT_EQ(read, declared());
}

TEST(CorrectedToml, NamesPossibleFurtherEffect) {
  calibration::Calibration calibration = found_guide_radius();
  calibration.effects.front().group.emplace_back("joint_sensor_gain");
  calibration.effects.front().beside = {{"joint_sensor_gain", {{"gain_percent", 1.25, 1, 1.5}}}};
  EXPECT_THAT(
      corrected_toml(k_declared, declared(), calibration, {}),
      HasSubstr(
          "do not distinguish them; perhaps with joint_sensor_gain: gain_percent = 1.25, 95 % within 1 to 1.5\n"));
}

TEST(CorrectedToml, SecondCalibrationReplacesFirst) {
  Correction correction;
  correction.identified = found_guide_radius().identified;
  const std::string once = corrected_toml(k_declared, declared(), found_guide_radius(), correction);
  EXPECT_EQ(corrected_toml(once, parse_mechanism(once, "a.toml"), found_guide_radius(), correction), once);
  correction.identified.pins.radius = 1.6;
  const std::string twice = corrected_toml(once, parse_mechanism(once, "a.toml"), found_guide_radius(), correction);
  EXPECT_EQ(parse_mechanism(twice, "b.toml").identified.pins.radius, 1.6);
  EXPECT_EQ(twice.find("\n[identified]"), twice.rfind("\n[identified]"));
}

/// One run up and down, simulated with hysteresis: θ lags by half of `width`, rad, each way.
struct HysteresisRun {
  measurement::Measurement measurement;
  calibration::Calibration calibration;
};

HysteresisRun hysteresis_run(const DeclaredMechanism& mechanism, double width) {
  const transmission::Transmission law(mechanism);
  HysteresisRun data;
  measurement::Run run;
  std::vector<double> before;
  for (int i = 0; i < 400; ++i) {
    const bool up = i < 200;
    const double share = up ? i / 199.0 : (399 - i) / 199.0;
    measurement::Sample sample;
    sample.alpha = law.alpha_min() + (law.alpha_max() - law.alpha_min()) * share;
    sample.theta = law.theta(sample.alpha) + (up ? -0.5 : 0.5) * width;
    run.samples.push_back(sample);
    before.push_back((up ? -0.5 : 0.5) * width);
  }
  run.strokes = {{0, 199, 1, 0, false}, {200, 399, -1, 0, false}};
  data.measurement.runs.push_back(run);
  data.calibration.residuals_before = {before};
  data.calibration.residuals_after = {std::vector<double>(400, 0.0)};
  data.calibration.identified.shaft.backlash = width / law.at_alpha(0).g;
  return data;
}

/// Logs the run as the identified joint does, in rows that were not fitted.
void log_as_identified(const DeclaredMechanism& mechanism, HysteresisRun& data) {
  measurement::Run& run = data.measurement.runs.front();
  run.name = "run.csv";
  calibration::Calibration& calibration = data.calibration;
  const joint::Readings theta = joint::predict(joint::expected_joint(mechanism), calibration.identified,
                                               measurement::bench_log(data.measurement));
  for (std::size_t i = 0; i < run.samples.size(); ++i) run.samples[i].theta = theta[0][i];
  calibration.left_out = {{{run.name}, calibration.identified}};
  calibration.effects.resize(1);
  calibration.before.held_out_rms = 1;
}

TEST(Correct, HysteresisGoesIntoTable) {
  const double width = radians(0.6);
  HysteresisRun data = hysteresis_run(frictionless(), width);
  log_as_identified(frictionless(), data);
  const Correction correction = correct(frictionless(), data.measurement, data.calibration);
  EXPECT_FALSE(correction.has_pulley);
  EXPECT_EQ(correction.by_pulley, 0);
  EXPECT_EQ(correction.error_with_pulley, correction.error_now);
  // The play is taken up in a few rows, which are omitted.
  EXPECT_GT(correction.by_table, 0.97 * correction.error_now);
  ASSERT_GT(correction.table.size(), 20u);
  const transmission::Transmission law(frictionless());
  for (const CompensationRow& row : correction.table) {
    const double play = data.calibration.identified.shaft.backlash;
    EXPECT_NEAR(row.alpha_up, law.alpha(row.theta) + 0.5 * play, 1e-3);
    EXPECT_NEAR(row.alpha_down, law.alpha(row.theta) - 0.5 * play, 1e-3);
  }
  EXPECT_THAT(compensation_csv(correction), HasSubstr("theta_deg,alpha_up_deg,alpha_down_deg\n"));
  EXPECT_THAT(compensation_csv(correction), Not(HasSubstr("nan")));
}

/// The joint is right, and its sensor reads wrong: a table would move it away from where it should be.
TEST(Correct, ErrorsOfJointSensorAreNotFollowed) {
  HysteresisRun data = hysteresis_run(frictionless(), 0);
  Imperfections& found = data.calibration.identified;
  found = {};
  found.sensor.zero = radians(1.0);
  found.sensor.gain = 0.02;
  log_as_identified(frictionless(), data);
  data.calibration.effects[0].place = ChainPlace::joint_sensor;
  const Correction sensor = correct(frictionless(), data.measurement, data.calibration);
  EXPECT_LT(degrees(sensor.error_now), 1e-3);
  EXPECT_TRUE(sensor.table.empty());
  EXPECT_EQ(sensor.why_no_table, "the joint sensor reads wrong, and the joint is right");
  // Beside play, the table is that of the play alone.
  found.shaft.backlash = radians(1.0);
  log_as_identified(frictionless(), data);
  data.calibration.effects[0].place = ChainPlace::shaft;
  const Correction both = correct(frictionless(), data.measurement, data.calibration);
  const transmission::Transmission law(frictionless());
  ASSERT_FALSE(both.table.empty());
  for (const CompensationRow& row : both.table) {
    EXPECT_NEAR(row.alpha_up, law.alpha(row.theta) + radians(0.5), 1e-3);
    EXPECT_NEAR(row.alpha_down, law.alpha(row.theta) - radians(0.5), 1e-3);
  }
}

TEST(Correct, GuideRadiusGoesIntoPulley) {
  HysteresisRun data = hysteresis_run(frictionless(), 0);
  data.calibration.identified = {};
  data.calibration.identified.pins.radius = 1.5;
  log_as_identified(frictionless(), data);
  const Correction correction = correct(frictionless(), data.measurement, data.calibration);
  EXPECT_TRUE(correction.has_pulley);
  EXPECT_FALSE(correction.round.suffices);
  EXPECT_GT(degrees(correction.error_now), 0.2);
  EXPECT_LT(degrees(correction.error_with_pulley), 1e-3);
  EXPECT_NEAR(correction.by_pulley, correction.error_now, 0.05 * correction.error_now);  // from fewer rows
  EXPECT_EQ(correction.why_no_pulley_file, "");
}

TEST(Correct, RejectsPulleyWithoutHeldOutGain) {
  HysteresisRun data = hysteresis_run(frictionless(), 0);
  data.calibration.identified = {};
  log_as_identified(frictionless(), data);
  data.calibration.identified.pins.radius = 1.5;  // the run shows none of this
  data.calibration.left_out.front().identified = data.calibration.identified;
  const Correction correction = correct(frictionless(), data.measurement, data.calibration);
  EXPECT_FALSE(correction.has_pulley);
  EXPECT_THAT(correction.why_no_pulley_file, HasSubstr("not fitted"));
}

TEST(Correct, RejectsTableWithoutHeldOutGain) {
  HysteresisRun data = hysteresis_run(frictionless(), 0);
  data.calibration.identified = {};
  log_as_identified(frictionless(), data);
  data.calibration.identified.shaft.backlash = radians(1.0);
  data.calibration.left_out.front().identified = data.calibration.identified;
  const Correction correction = correct(frictionless(), data.measurement, data.calibration);
  EXPECT_TRUE(correction.table.empty());
  EXPECT_THAT(correction.why_no_table, HasSubstr("not fitted"));
}

TEST(Correct, RatioHasTableOnly) {
  const DeclaredMechanism jaw =
      parse_mechanism("schema = 1\nname = \"jaw\"\n[transmission]\nkind = \"ratio\"\nratio = -1.1\n", "jaw.toml");
  HysteresisRun data = hysteresis_run(declared(), radians(1.0));
  data.calibration.identified.shaft.backlash = 2 * 1.1 * radians(0.5);
  log_as_identified(jaw, data);
  const Correction correction = correct(jaw, data.measurement, data.calibration);
  EXPECT_FALSE(correction.has_pulley);
  ASSERT_FALSE(correction.table.empty());
  for (const CompensationRow& row : correction.table) {
    EXPECT_NEAR(row.alpha_up, -1.1 * (row.theta - radians(0.5)), 1e-3);
    EXPECT_NEAR(row.alpha_down, -1.1 * (row.theta + radians(0.5)), 1e-3);
  }
  // The zero of a ratio joint is arbitrary. A jaw at 77° once got a table that claimed to correct 76.7°.
  data.calibration.identified.sensor.zero = radians(77);
  log_as_identified(jaw, data);
  const Correction elsewhere = correct(jaw, data.measurement, data.calibration);
  EXPECT_NEAR(elsewhere.error_now, correction.error_now, 1e-9);
  EXPECT_NEAR(elsewhere.by_table, correction.by_table, 1e-9);
  ASSERT_EQ(elsewhere.table.size(), correction.table.size());
  for (std::size_t i = 0; i < correction.table.size(); ++i)
    EXPECT_NEAR(elsewhere.table[i].theta, correction.table[i].theta + radians(77), 1e-9);
}

}  // namespace
}  // namespace fusee::correction
