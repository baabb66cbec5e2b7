// Corrected pulleys on a rig that shares no equation with what made them: the same joint, the same fault, another pulley.
#include "calibration/whole_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fusee/base/files.h"
#include "fusee/mechanism/file.h"

namespace fusee::rig {
namespace {

std::filesystem::path scratch(const std::string& name) { return std::filesystem::path(testing::TempDir()) / ("fusee_loop_" + name); }

struct Joint {
  std::string spec;
  MadeJoint made;
};

constexpr double k_load = 5;  // N

Joint joint_of(const std::string& file, bool friction = true) {
  Joint joint;
  joint.spec = read_file(std::filesystem::path(FUSEE_SOURCE_DIR) / file, 1 << 20);
  Mechanism declared = parse_mechanism(joint.spec, file);
  if (!friction) declared.guides.mu = 0;
  joint.made = make_joint(declared);
  return joint;
}

/// What a perfect calibration would say.
Imperfections truth_of(const Hidden& hidden, const Mechanism& declared) {
  Imperfections at;
  at.radius_offset = hidden.radius_offset;
  at.pulley_scale = hidden.pulley_scale;
  at.runout_x = hidden.runout_x;
  at.runout_y = hidden.runout_y;
  at.guide_radius = hidden.guide_radius;
  at.guide_outward = hidden.guide_outward;
  at.guide_down = hidden.guide_down;
  at.joint_length = hidden.joint_length;
  if (hidden.modulus > 0) at.stretch = declared.tendon.modulus / hidden.modulus - 1;
  at.gravity_cos = hidden.gravity * std::sin(hidden.gravity_direction);
  at.gravity_sin = -hidden.gravity * std::cos(hidden.gravity_direction);
  return at;
}

LoopCase case_of(const Joint& joint, const std::string& name) {
  for (const LoopCase& one : loop_cases(joint.made.declared, k_load)) {
    if (one.name == name) return one;
  }
  ADD_FAILURE() << name;
  return {};
}

/// The correction for what is truly there.
Correction known_correction(const Joint& joint, const LoopCase& hidden) {
  Calibration calibration;
  calibration.verdict = "explained";
  calibration.identified = truth_of(hidden.hidden, joint.made.declared);
  return correct(joint.made.declared, measured(joint.made, hidden, scratch(hidden.name)), calibration);
}

MadeJoint corrected_joint(const Joint& joint, const Correction& correction) {
  Mechanism corrected = joint.made.declared;
  corrected.identified = correction.identified;
  return with_corrected_pulley(joint.made, corrected);
}

class Known : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(Known, FaultIsTakenOutByThePulley) {
  const auto [file, name] = GetParam();
  // Without friction: its loop under load is none of the pulley's.
  const Joint joint = joint_of(file, false);
  const LoopCase hidden = case_of(joint, name);
  const Correction correction = known_correction(joint, hidden);
  ASSERT_TRUE(correction.has_pulley) << correction.infeasible;
  const double before = joint_error(joint.made, hidden, 0);
  const double floor = joint_error(joint.made, {}, 0);
  const double after = joint_error(corrected_joint(joint, correction), hidden, correction.tied_at);
  EXPECT_GT(degrees(before), 0.02);
  EXPECT_LT(after, 0.02 * before + 2 * floor);
}

INSTANTIATE_TEST_SUITE_P(WholeLoop, Known,
                         testing::Combine(testing::Values("profiles/forearm.toml", "profiles/unsymmetric.toml", "tests/data/rig/d_guide_radius/spec.toml"),
                                          testing::Values("radius_offset", "pulley_scale", "pulley_runout", "guide_radius", "guide_position",
                                                          "joint_length", "tendon_stretch", "gravity")),
                         [](const auto& each) {
                           const std::string file = std::get<0>(each.param);
                           const std::string joint = file.find("forearm") != std::string::npos ? "forearm" : file.find("unsym") != std::string::npos ? "unsymmetric" : "rig";
                           return joint + "_" + std::get<1>(each.param);
                         });

TEST(WholeLoop, TheWrongCauseIsSeen) {
  // The same loop with half of the truth leaves half of the error: the rig does not take the correction's word.
  const Joint joint = joint_of("profiles/forearm.toml");
  const LoopCase hidden = case_of(joint, "pulley_runout");
  Correction half = known_correction(joint, hidden);
  half.identified.runout_x *= 0.5;
  half.identified.runout_y *= 0.5;
  const double before = joint_error(joint.made, hidden, 0);
  EXPECT_NEAR(joint_error(corrected_joint(joint, half), hidden, 0) / before, 0.5, 0.05);
}

TEST(WholeLoop, ATableTakesOutWhatTheUntiedLoadLeaves) {
  const Joint joint = joint_of("profiles/forearm.toml");
  const LoopCase hidden = case_of(joint, "tendon_stretch");
  const Correction correction = known_correction(joint, hidden);
  EXPECT_LT(degrees(correction.tied_at), -0.2);  // the motor pulls ahead of the load
  const double after = joint_error(corrected_joint(joint, correction), hidden, 0);
  EXPECT_NEAR(after, correction.error_with_pulley, 0.2 * after);
  EXPECT_LT(correction.error_with_table, correction.error_with_pulley);
}

/// From what the bench logged to the pulley, nothing told.
class Found : public testing::TestWithParam<const char*> {};

TEST_P(Found, FaultIsTakenOutByThePulley) {
  const Joint joint = joint_of("profiles/forearm.toml");
  const LoopOutcome outcome = turn_loop(joint.made, joint.spec, case_of(joint, GetParam()), scratch(std::string("found_") + GetParam()));
  EXPECT_LT(outcome.after, 0.15 * outcome.before) << outcome.found;
  EXPECT_NE(outcome.corrected_toml.find(joint.spec), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(WholeLoop, Found, testing::Values("pulley_scale", "tendon_stretch"), [](const auto& each) { return each.param; });

}  // namespace
}  // namespace fusee::rig
