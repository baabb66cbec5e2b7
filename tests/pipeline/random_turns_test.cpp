// Random joints whose pulleys have several turns, through the whole build: each is built with all checks, or refused
// for its design, never for its mesh. FUSEE_LAW_CASES: number of joints (24); FUSEE_LAW_SEED: seed (1).
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/pipeline.h"
#include "support/campaign.h"

namespace {

using namespace fusee;
using fusee::testing::BuildEnd;
using fusee::testing::Dice;
using fusee::testing::number_in;

/// A random number as text, with three decimals.
std::string number_between(Dice& dice, double low, double high) {
  return fmt::format("{:.3f}", dice.between(low, high));
}

struct MultiTurnJoint {
  std::string profile;
  std::vector<Setting> settings;

  std::string words() const {
    std::string text = profile;
    for (const Setting& setting : settings) text += " " + setting.key + "=" + setting.value;
    return text;
  }
};

void add_wrist(Dice& dice, std::vector<Setting>& settings) {
  settings.push_back({"joint.length_mm", number_between(dice, 80, 250)});
  settings.push_back(
      {"joint.range_deg", fmt::format("[{}, {}]", number_between(dice, -45, -15), number_between(dice, 15, 45))});
  settings.push_back({"guides.EB_mm", number_between(dice, 60, 160)});
  settings.push_back({"guides.ED_mm", number_between(dice, 60, 160)});
  if (dice.happens(0.7)) {
    settings.push_back({"pulley.ratio", number_between(dice, 5, 22)});
  } else {
    settings.push_back({"pulley.law", "compensate"});
    settings.push_back({"pulley.r1_mm", number_between(dice, 5, 16)});
  }
}

void add_capstan(Dice& dice, std::vector<Setting>& settings) {
  const double drum = dice.between(40, 95);
  // Attachments and pins lie as in the profile, in proportion to its drum of 90 mm: at 63.85 and 130 mm.
  const std::string attachment = fmt::format("[{0:.3f}, {1:.3f}]", -0.7094 * drum, 0.7094 * drum);
  settings.push_back({"joint.drum_radius_mm", fmt::format("{:.3f}", drum)});
  settings.push_back({"joint.length_mm", fmt::format("{:.3f}", drum + 0.3)});
  settings.push_back({"joint.attachment1_mm", attachment});
  settings.push_back({"joint.attachment2_mm", attachment});
  settings.push_back({"guides.EB_mm", fmt::format("{:.3f}", 1.45 * drum)});
  settings.push_back({"guides.ED_mm", fmt::format("{:.3f}", 1.45 * drum)});
  settings.push_back({"guides.OE_mm", fmt::format("{:.3f}", 1.45 * drum)});
  settings.push_back(
      {"joint.range_deg", fmt::format("[{}, {}]", number_between(dice, -18, -5), number_between(dice, 30, 100))});
  settings.push_back({"pulley.r1_mm", number_between(dice, 4.5, 14)});
}

MultiTurnJoint draw_joint(std::uint64_t seed) {
  Dice dice(seed);
  const bool wrist = dice.happens(0.6);
  MultiTurnJoint joint{wrist ? "wrist_turns" : "elbow_capstan", {}};
  std::vector<Setting>& settings = joint.settings;
  (wrist ? add_wrist : add_capstan)(dice, settings);
  settings.push_back({"pulley.EF_mm", number_between(dice, 80, 300)});
  settings.push_back({"tendon.diameter_mm", number_between(dice, 0.3, 1.2)});
  const auto perhaps = [&](double probability, const char* key, const std::string& value) {
    if (dice.happens(probability)) settings.push_back({key, value});
  };
  perhaps(0.3, "guides.collar", "true");
  perhaps(0.5, "body.spare_turns", number_between(dice, 0.3, 2));
  perhaps(0.2, "body.lead_mm", number_between(dice, 2.5, 8));
  perhaps(0.4, "body.groove", dice.one_of(std::array{"u", "v", "flat"}));
  perhaps(0.3, "body.groove_depth_mm", number_between(dice, 0.8, 2.5));
  perhaps(0.2, "body.groove_angle_deg", number_between(dice, 30, 90));
  perhaps(0.3, "body.flange_thickness_mm", number_between(dice, 0.8, 3));
  perhaps(0.2, "body.bore_diameter_mm", number_between(dice, 2, 6));
  perhaps(0.1, "print.supports", "true");
  return joint;
}

struct Outcome {
  BuildEnd end = BuildEnd::refused;
  double theta_error = 0;  ///< rad
};

/// The design causes a refusal, not the mesh: its conditions are named "features" and "body_…".
void expect_reasons_of_design(const std::vector<profile::Condition>& conditions) {
  for (const profile::Condition& condition : profile::failed_of(conditions)) {
    EXPECT_NE(condition.name, "features") << condition.message;
    EXPECT_NE(condition.name.rfind("body_", 0), 0u) << condition.message;
  }
}

Outcome outcome_of(const MultiTurnJoint& joint, pipeline::BuildOptions options) {
  options.dry_run = true;
  options.advice = false;  // tested elsewhere
  const auto path = std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / (joint.profile + ".toml");
  try {
    const pipeline::BuildResult built = pipeline::build(read_mechanism(path, joint.settings), options);
    for (const Check& check : built.product.checks)
      EXPECT_TRUE(check.ok) << check.name << " " << check.value << ", limit " << check.limit << "; " << check.where;
    expect_reasons_of_design(built.product.pulley.conditions);
    if (built.status == pipeline::BuildStatus::infeasible) return {BuildEnd::refused, 0};
    return {BuildEnd::made, built.product.as_built.max_theta_error};
  } catch (const InputError&) {
    return {BuildEnd::bad_input, 0};
  }
}

constexpr int k_shards = 4;  // so that ctest can run them in parallel

class RandomTurns : public ::testing::TestWithParam<int> {};

TEST_P(RandomTurns, AreBuiltOrRefusedForDesign) {
  const int cases = number_in("FUSEE_LAW_CASES", 24), seed = number_in("FUSEE_LAW_SEED", 1);
  int made = 0, refused = 0, bad = 0;
  double worst = 0;
  for (int i = GetParam(); i < cases; i += k_shards) {
    const MultiTurnJoint joint = draw_joint(static_cast<std::uint64_t>(seed) * 1000003 + static_cast<std::uint64_t>(i));
    SCOPED_TRACE(fmt::format("joint {} of seed {}: {}", i, seed, joint.words()));
    const Outcome outcome = outcome_of(joint, {});
    worst = std::max(worst, outcome.theta_error);
    if (outcome.end == BuildEnd::made) ++made;
    if (outcome.end == BuildEnd::refused) ++refused;
    if (outcome.end == BuildEnd::bad_input) ++bad;
  }
  EXPECT_GT(made, 0);
  EXPECT_LT(degrees(worst), 0.05);
  std::printf("%d made, %d refused, %d bad input; wound within %.4f deg\n", made, refused, bad, degrees(worst));
}

INSTANTIATE_TEST_SUITE_P(Turns, RandomTurns, ::testing::Range(0, k_shards));

}  // namespace
