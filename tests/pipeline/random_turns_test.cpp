// Random joints whose pulleys have several turns, through the whole build: each is built with all checks, or refused
// for its design, never for its mesh. FUSEE_LAW_CASES: number of joints (24); FUSEE_LAW_SEED: seed (1).
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/pipeline.h"

namespace {

using namespace fusee;

/// A random number generator with equal results on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53; }
  bool happens(double probability) { return between(0, 1) < probability; }
  std::string number(double low, double high) { return fmt::format("{:.3f}", between(low, high)); }
  template <std::size_t count>
  const char* one_of(const std::array<const char*, count>& words) {
    return words[static_cast<std::size_t>(between(0, static_cast<double>(count)))];
  }

 private:
  std::mt19937_64 bits_;
};

struct TurningJoint {
  std::string profile;
  std::vector<Setting> settings;

  std::string words() const {
    std::string text = profile;
    for (const Setting& setting : settings) text += " " + setting.key + "=" + setting.value;
    return text;
  }
};

void add_wrist(Dice& dice, std::vector<Setting>& settings) {
  settings.push_back({"joint.length_mm", dice.number(80, 250)});
  settings.push_back({"joint.range_deg", fmt::format("[{}, {}]", dice.number(-45, -15), dice.number(15, 45))});
  settings.push_back({"guides.EB_mm", dice.number(60, 160)});
  settings.push_back({"guides.ED_mm", dice.number(60, 160)});
  if (dice.happens(0.7)) {
    settings.push_back({"pulley.ratio", dice.number(5, 22)});
  } else {
    settings.push_back({"pulley.law", "compensate"});
    settings.push_back({"pulley.r1_mm", dice.number(5, 16)});
  }
}

void add_capstan(Dice& dice, std::vector<Setting>& settings) {
  const double drum = dice.between(40, 95);
  const std::string tie = fmt::format("[{0:.3f}, {1:.3f}]", -0.7094 * drum, 0.7094 * drum);
  settings.push_back({"joint.drum_radius_mm", fmt::format("{:.3f}", drum)});
  settings.push_back({"joint.length_mm", fmt::format("{:.3f}", drum + 0.3)});
  settings.push_back({"joint.attachment1_mm", tie});
  settings.push_back({"joint.attachment2_mm", tie});
  // The pins lie as in the profile, in proportion to the drum.
  settings.push_back({"guides.EB_mm", fmt::format("{:.3f}", 1.45 * drum)});
  settings.push_back({"guides.ED_mm", fmt::format("{:.3f}", 1.45 * drum)});
  settings.push_back({"guides.OE_mm", fmt::format("{:.3f}", 1.45 * drum)});
  settings.push_back({"joint.range_deg", fmt::format("[{}, {}]", dice.number(-18, -5), dice.number(30, 100))});
  settings.push_back({"pulley.r1_mm", dice.number(4.5, 14)});
}

TurningJoint draw_joint(std::uint64_t seed) {
  Dice dice(seed);
  const bool wrist = dice.happens(0.6);
  TurningJoint joint{wrist ? "wrist_turns" : "elbow_capstan", {}};
  std::vector<Setting>& settings = joint.settings;
  (wrist ? add_wrist : add_capstan)(dice, settings);
  settings.push_back({"pulley.EF_mm", dice.number(80, 300)});
  settings.push_back({"tendon.diameter_mm", dice.number(0.3, 1.2)});
  const auto perhaps = [&](double probability, const char* key, const std::string& value) {
    if (dice.happens(probability)) settings.push_back({key, value});
  };
  perhaps(0.3, "guides.collar", "true");
  perhaps(0.5, "body.spare_turns", dice.number(0.3, 2));
  perhaps(0.2, "body.lead_mm", dice.number(2.5, 8));
  perhaps(0.4, "body.groove", dice.one_of(std::array{"u", "v", "flat"}));
  perhaps(0.3, "body.groove_depth_mm", dice.number(0.8, 2.5));
  perhaps(0.2, "body.groove_angle_deg", dice.number(30, 90));
  perhaps(0.3, "body.flange_thickness_mm", dice.number(0.8, 3));
  perhaps(0.2, "body.bore_diameter_mm", dice.number(2, 6));
  perhaps(0.1, "print.supports", "true");
  return joint;
}

enum class End { made, refused, bad_input };

struct Outcome {
  End end = End::refused;
  double theta_error = 0;  ///< rad
};

void expect_true_reasons(const std::vector<profile::Condition>& conditions) {
  for (const profile::Condition& condition : profile::failed_of(conditions)) {
    EXPECT_NE(condition.name, "features") << condition.message;
    EXPECT_NE(condition.name.rfind("body_", 0), 0u) << condition.message;
  }
}

Outcome outcome_of(const TurningJoint& joint, pipeline::BuildOptions options) {
  options.dry_run = true;
  options.advice = false;  // tested elsewhere
  const auto path = std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / (joint.profile + ".toml");
  try {
    const pipeline::BuildResult built = pipeline::build(read_mechanism(path, joint.settings), options);
    for (const Check& check : built.product.checks)
      EXPECT_TRUE(check.ok) << check.name << " " << check.value << ", limit " << check.limit << "; " << check.where;
    expect_true_reasons(built.product.pulley.conditions);
    if (built.status == pipeline::BuildStatus::infeasible) return {End::refused, 0};
    return {End::made, built.product.as_built.max_theta_error};
  } catch (const InputError&) {
    return {End::bad_input, 0};
  }
}

int number_of(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atoi(text);
}

constexpr int k_shards = 4;  // so that ctest can run them in parallel

class RandomTurns : public ::testing::TestWithParam<int> {};

TEST_P(RandomTurns, AreBuiltOrRefusedForDesign) {
  const int cases = number_of("FUSEE_LAW_CASES", 24), seed = number_of("FUSEE_LAW_SEED", 1);
  int made = 0, refused = 0, bad = 0;
  double worst = 0;
  for (int i = GetParam(); i < cases; i += k_shards) {
    const TurningJoint joint = draw_joint(static_cast<std::uint64_t>(seed) * 1000003 + static_cast<std::uint64_t>(i));
    SCOPED_TRACE(fmt::format("joint {} of seed {}: {}", i, seed, joint.words()));
    const Outcome outcome = outcome_of(joint, {});
    worst = std::max(worst, outcome.theta_error);
    ++(outcome.end == End::made ? made : outcome.end == End::refused ? refused : bad);
  }
  EXPECT_GT(made, 0);
  EXPECT_LT(degrees(worst), 0.05);
  std::printf("%d made, %d refused, %d bad input; wound within %.4f deg\n", made, refused, bad, degrees(worst));
}

INSTANTIATE_TEST_SUITE_P(Turns, RandomTurns, ::testing::Range(0, k_shards));

}  // namespace
