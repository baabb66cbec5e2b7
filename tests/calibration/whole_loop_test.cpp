// Corrected pulleys on a rig that shares no equation with what made them: the same joint, the same fault, another
// pulley.
#include "calibration/whole_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "fusee/pipeline.h"

namespace fusee::rig {
namespace {

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / ("fusee_loop_" + name);
}

struct Joint {
  std::string spec;
  MadeJoint made;
};

constexpr double k_load = 5;  // N

Joint joint_of(const std::string& file, bool friction = true) {
  Joint joint;
  joint.spec = read_file(std::filesystem::path(FUSEE_SOURCE_DIR) / file, 1 << 20);
  DeclaredMechanism declared = parse_mechanism(joint.spec, file);
  if (!friction) declared.guides.mu = 0;
  joint.made = make_joint(declared);
  return joint;
}

/// The identified numbers of a perfect calibration.
Imperfections truth_of(const HiddenFaults& hidden, const DeclaredMechanism& declared) {
  Imperfections at;
  at.pulley.outline.offset = hidden.radius_offset;
  at.pulley.scale = hidden.pulley_scale;
  at.pulley.outline.runout_x = hidden.runout_x;
  at.pulley.outline.runout_y = hidden.runout_y;
  at.pins.radius = hidden.guide_radius;
  at.pins.left = {hidden.guide_outward + hidden.pin_outward[0], hidden.guide_down + hidden.pin_down[0]};
  at.pins.right = {hidden.guide_outward + hidden.pin_outward[1], hidden.guide_down + hidden.pin_down[1]};
  at.joint.length = hidden.joint_length;
  if (hidden.modulus > 0) at.tendon.stretch = declared.tendon.modulus / hidden.modulus - 1;
  at.joint.weight.cos = hidden.gravity * std::sin(hidden.gravity_direction);
  at.joint.weight.sin = -hidden.gravity * std::cos(hidden.gravity_direction);
  return at;
}

LoopCase case_of(const Joint& joint, const std::string& name) {
  for (const LoopCase& one : loop_cases(joint.made.declared, k_load)) {
    if (one.name == name) return one;
  }
  ADD_FAILURE() << name;
  return {};
}

/// The correction after a perfect calibration.
correction::Correction known_correction(const Joint& joint, const LoopCase& hidden) {
  calibration::Calibration calibration;
  calibration.verdict = calibration::CalibrationVerdict::explained;
  calibration.identified = truth_of(hidden.hidden, joint.made.declared);
  const measurement::Measurement measurement = measured(joint.made, hidden, scratch(hidden.name));
  for (const measurement::Run& run : measurement.runs)
    calibration.left_out.push_back({{run.name}, calibration.identified});
  return correction::correct(joint.made.declared, measurement, calibration);
}

MadeJoint corrected_joint(const Joint& joint, const correction::Correction& correction) {
  DeclaredMechanism corrected = joint.made.declared;
  corrected.identified = correction.identified;
  return with_corrected_pulley(joint.made, corrected);
}

class KnownFault : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(KnownFault, PulleyCorrectsFault) {
  const auto [file, name] = GetParam();
  // Without friction, because no pulley corrects its hysteresis under load.
  const Joint joint = joint_of(file, false);
  const LoopCase hidden = case_of(joint, name);
  const correction::Correction correction = known_correction(joint, hidden);
  ASSERT_TRUE(correction.has_pulley) << correction.infeasible;
  const double before = joint_error(joint.made, hidden, 0);
  const double floor = joint_error(joint.made, {}, 0);
  const double after = joint_error(corrected_joint(joint, correction), hidden, correction.assembly_angle);
  EXPECT_GT(degrees(before), 0.02);
  EXPECT_LT(after, 0.025 * before + 2 * floor);
}

// The rig winds strings in space on the spirals of both pulleys, before and after the correction.
INSTANTIATE_TEST_SUITE_P(MultiTurn, KnownFault,
                         testing::Combine(testing::Values("profiles/wrist_turns.toml"),
                                          testing::Values("radius_offset", "pulley_runout", "guide_position",
                                                          "tendon_stretch")),
                         [](const auto& each) { return std::string(std::get<1>(each.param)); });

INSTANTIATE_TEST_SUITE_P(WholeLoop, KnownFault,
                         testing::Combine(testing::Values("profiles/forearm.toml", "profiles/unsymmetric.toml",
                                                          "tests/data/rig/d_guide_radius/spec.toml"),
                                          testing::Values("radius_offset", "pulley_scale", "pulley_runout",
                                                          "guide_radius", "guide_position", "joint_length",
                                                          "tendon_stretch", "gravity")),
                         [](const auto& each) {
                           const std::string file = std::get<0>(each.param);
                           const std::string joint = file.find("forearm") != std::string::npos ? "forearm"
                                                     : file.find("unsym") != std::string::npos ? "unsymmetric"
                                                                                               : "rig";
                           return joint + "_" + std::get<1>(each.param);
                         });

pipeline::BuildResult built(const DeclaredMechanism& corrected, double tolerance = 0.01) {
  MechanismFile file;
  file.mechanism = corrected;
  pipeline::BuildOptions options;
  options.chord_error_mm = tolerance;
  options.folder = scratch("build");
  options.dry_run = true;
  return pipeline::build(file, options);
}

TEST_P(KnownFault, CorrectedPulleyPassesAllChecks) {
  const auto [file, name] = GetParam();
  const Joint joint = joint_of(file);
  DeclaredMechanism corrected = joint.made.declared;
  corrected.identified = known_correction(joint, case_of(joint, name)).identified;
  const pipeline::BuildResult result = built(corrected);
  EXPECT_EQ(result.status, pipeline::BuildStatus::done) << result.product.synthesis.brief();
  for (const Check& check : result.product.checks)
    EXPECT_TRUE(check.ok) << check.name << " " << check.value << " " << check.where;
}

/// Groove floor of the drawing, as the pitch curve of the rig's outline.
profile::Outline outline_of(const pipeline::BuildResult& result, const std::string& layer, transmission::Side side,
                            double diameter) {
  for (const OutputFile& output : result.outputs) {
    if (output.name != "profile.dxf") continue;
    for (const formats::DrawingPath& path : formats::read_dxf(output.bytes, output.name).paths) {
      if (path.layer != layer) continue;
      const Polygon corners = convex_hull(path.points);
      profile::Outline outline;
      outline.side = side;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 along = corners[(i + 1) % corners.size()] - corners[(i + corners.size() - 1) % corners.size()];
        profile::OutlinePoint point;
        point.normal = Vec2(along.y(), -along.x()).normalized();
        point.psi = std::atan2(point.normal.y(), point.normal.x());
        point.position = corners[i] + 0.5 * diameter * point.normal;
        outline.points.push_back(point);
      }
      return outline;
    }
  }
  ADD_FAILURE() << layer;
  return {};
}

TEST(WholeLoop, DrawingOfBuildCorrectsFault) {
  const Joint joint = joint_of("profiles/forearm.toml");
  LoopCase hidden = case_of(joint, "pulley_runout");
  hidden.hidden.radius_offset = -0.2;
  hidden.hidden.guide_outward = 0.5;
  DeclaredMechanism corrected = joint.made.declared;
  corrected.identified = known_correction(joint, hidden).identified;
  const pipeline::BuildResult result = built(corrected, 2e-4);
  MadeJoint drawn = joint.made;
  drawn.p1 = outline_of(result, "P1_FLOOR", transmission::Side::left, corrected.tendon.diameter);
  drawn.p2 = outline_of(result, "P2_FLOOR", transmission::Side::right, corrected.tendon.diameter);
  EXPECT_GT(degrees(joint_error(joint.made, hidden, 0)), 0.3);
  EXPECT_LT(degrees(joint_error(drawn, hidden, 0)), 0.01);
}

TEST(WholeLoop, HalfCorrectionLeavesHalfTheError) {
  // The rig measures the joint independently of the correction.
  const Joint joint = joint_of("profiles/forearm.toml");
  const LoopCase hidden = case_of(joint, "pulley_runout");
  correction::Correction half = known_correction(joint, hidden);
  half.identified.pulley.outline.runout_x *= 0.5;
  half.identified.pulley.outline.runout_y *= 0.5;
  const double before = joint_error(joint.made, hidden, 0);
  EXPECT_NEAR(joint_error(corrected_joint(joint, half), hidden, 0) / before, 0.5, 0.05);
}

TEST(WholeLoop, TableCorrectsErrorWithoutAssemblyAngle) {
  const Joint joint = joint_of("profiles/forearm.toml");
  const LoopCase hidden = case_of(joint, "tendon_stretch");
  const correction::Correction correction = known_correction(joint, hidden);
  EXPECT_LT(degrees(correction.assembly_angle), -0.2);  // the motor pulls ahead of the load
  const double after = joint_error(corrected_joint(joint, correction), hidden, 0);
  EXPECT_NEAR(after, correction.error_with_pulley, 0.2 * after);
  EXPECT_LT(correction.error_with_table, correction.error_with_pulley);
}

TEST(WholeLoop, ContinuesFromCorrectedFile) {
  // The joint is logged again with the corrected pulley, whose file describes it. Calibration then identifies nothing
  // new and keeps the earlier numbers.
  const Joint joint = joint_of("profiles/forearm.toml");
  const LoopCase hidden = case_of(joint, "guide_position");
  const correction::Correction first = known_correction(joint, hidden);
  DeclaredMechanism corrected = joint.made.declared;
  corrected.identified = first.identified;
  const measurement::Measurement again = measured(corrected_joint(joint, first), hidden, scratch("again"));
  const calibration::Calibration second = calibration::calibrate(joint::expected_joint(corrected), again);
  EXPECT_EQ(second.verdict, calibration::CalibrationVerdict::no_effect) << second.summary;
  EXPECT_LT(degrees(second.before.rms), 0.022);
  EXPECT_EQ(correction::correct(corrected, again, second).identified, first.identified);
}

TEST(WholeLoop, LaterFindingIsAdded) {
  const Joint joint = joint_of("profiles/forearm.toml");
  DeclaredMechanism corrected = joint.made.declared;
  corrected.identified.pins.radius = 1;
  corrected.identified.tendon.stretch = 1;
  corrected.identified.pulley.scale = 0.01;
  corrected.identified.shaft.backlash = 0.02;
  calibration::Calibration second;
  second.identified.pins.radius = 0.5;
  second.identified.tendon.stretch = 0.5;
  second.identified.pulley.scale = 0.01;
  const Imperfections total =
      correction::correct(corrected, measured(joint.made, case_of(joint, "guide_radius"), scratch("added")), second)
          .identified;
  EXPECT_EQ(total.pins.radius, 1.5);
  EXPECT_EQ(total.tendon.stretch, 2.0);
  EXPECT_NEAR(total.pulley.scale, 0.0201, 1e-12);
  EXPECT_EQ(total.shaft.backlash, 0);  // corrected by a table only: removed unless identified again
}

/// From the log to the corrected pulley, with nothing but the log known.
class FoundFault : public testing::TestWithParam<const char*> {};

TEST_P(FoundFault, PulleyCorrectsFault) {
  const Joint joint = joint_of("profiles/forearm.toml");
  const LoopOutcome outcome =
      turn_loop(joint.made, joint.spec, case_of(joint, GetParam()), scratch(std::string("found_") + GetParam()));
  EXPECT_LT(outcome.after, 0.15 * outcome.before) << outcome.found;
  EXPECT_NE(outcome.corrected_toml.find(joint.spec), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(WholeLoop, FoundFault, testing::Values("pulley_scale", "tendon_stretch"),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace fusee::rig
