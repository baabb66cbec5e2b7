// Random joints of the wide class through the whole build: drums, attachments, idlers, sheaths and torque laws, with
// motors and inches. Each is built with all checks and rewinds to its law, or is refused with a reason.
// FUSEE_LAW_CASES: number of joints (24); FUSEE_LAW_SEED: seed (1); FUSEE_LONG_TESTS: with advice. Each advised
// change is then tested.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

#include "fusee/base.h"
#include "fusee/kit.h"
#include "fusee/mechanism_file.h"
#include "fusee/pipeline.h"
#include "support/campaign.h"
#include "support/motor_and_units.h"

namespace {

using namespace fusee;
using fusee::testing::BuildEnd;
using fusee::testing::Dice;
using fusee::testing::number_in;

/// A mechanism file that grows table by table.
struct WideText {
  std::string text;
  double low = 0, high = 0;  ///< of the joint, deg
  double size = 0;           ///< of its tendons' arms, mm

  void table(std::string_view name) { text += fmt::format("\n[{}]\n", name); }
  void number(std::string_view key, double value) { text += fmt::format("{} = {:.6g}\n", key, value); }
  void word(std::string_view key, std::string_view value) { text += fmt::format("{} = \"{}\"\n", key, value); }
};

/// The end of a tendon: on the drum, sometimes inside of it, or anywhere near the joint. `drum`: radius of its centre
/// line there, mm; 0: no drum. `sign`: −1 for tendon 1, +1 for tendon 2.
void add_end(Dice& dice, WideText& file, std::string_view key, double drum, double sign) {
  const bool on_drum = drum > 0 && dice.happens(0.6);
  const double away = on_drum    ? drum * (dice.happens(0.1) ? dice.between(0.7, 1) : dice.between(1, 1.03))
                      : drum > 0 ? drum * dice.between(0.95, 2)
                                 : file.size * dice.between(0.6, 1.5);
  const double angle = radians(sign * (on_drum ? dice.between(-120, 60) : dice.between(-20, 90)));
  file.text += fmt::format("{} = [{:.6g}, {:.6g}]\n", key, away * std::sin(angle), away * std::cos(angle));
}

void add_joint(Dice& dice, WideText& file) {
  file.size = dice.log_between(5, 120);
  const double tendon = std::clamp(file.size * dice.log_between(0.01, 0.06), 0.2, 4.0);
  const bool drum = dice.happens(0.7);
  file.low = dice.happens(0.1) ? 0.0 : -dice.log_between(5, 100);
  file.high = dice.log_between(10, 150);
  file.table("joint");
  file.number("length_mm", file.size * (drum ? dice.between(1.1, 6) : dice.between(0.9, 3)));
  file.text += fmt::format("range_deg = [{:.6g}, {:.6g}]\n", file.low, file.high);
  const double drum_radius = drum ? file.size : 0;
  if (drum) file.number("drum_radius_mm", drum_radius);
  if (drum || dice.happens(0.8))
    add_end(dice, file, "attachment1_mm", drum_radius == 0 ? 0 : drum_radius + 0.5 * tendon, -1);
  if (drum || dice.happens(0.8))
    add_end(dice, file, "attachment2_mm", drum_radius == 0 ? 0 : drum_radius + 0.5 * tendon, 1);
  file.table("tendon");
  file.number("diameter_mm", tendon);
  file.number("pretension_N", dice.log_between(1, 60));
  if (dice.happens(0.5)) file.number("modulus_MPa", dice.log_between(5000, 150000));
}

void add_guides(Dice& dice, WideText& file) {
  file.table("guides");
  const double EB = file.size * dice.between(0.5, 2);
  file.number("EB_mm", EB);
  file.number("ED_mm", dice.happens(0.5) ? EB : file.size * dice.between(0.5, 2));
  file.number("OE_mm", file.size * (dice.happens(0.9) ? dice.between(0.5, 3.5) : dice.between(-1, 0.5)));
  file.number("radius_mm", std::min(20.0, file.size * dice.log_between(0.05, 0.5)));
  if (dice.happens(0.3)) {
    file.word("kind", "idler");
    file.number("bearing_radius_mm", file.size * dice.between(0.01, 0.05));
    file.number("bearing_friction", dice.log_between(0.001, 0.2));
  } else if (dice.happens(0.5)) {
    file.number("friction", dice.between(0, 0.4));
  }
}

void add_sheath(Dice& dice, WideText& file, double pulley) {
  file.table("sheath");
  file.number("length_mm", dice.log_between(50, 2000));
  file.number("bend_deg", dice.between(0, 540));
  file.number("friction", dice.between(0, 0.3));
  if (dice.happens(0.5)) file.number("stiffness_N_per_mm", dice.log_between(20, 2000));
  file.number("exit_across_mm", pulley * dice.between(0.3, 2.2));
  file.number("exit_above_mm", pulley * dice.between(1.5, 7));
}

/// One motor torque against a weight, a spring or both; sometimes of the wrong sign.
void add_torque_law(Dice& dice, WideText& file, double ratio) {
  const double weight = dice.log_between(0.1, 5), lever = file.size * dice.between(1, 6), tilt = dice.between(60, 170);
  const double mean = weight * 9.80665 * lever * std::sin(radians(tilt - 0.5 * (file.low + file.high)));
  file.number("motor_torque_Nmm", (dice.happens(0.05) ? -1 : 1) * std::max(1.0, std::abs(mean)) / ratio);
  file.table("load");
  file.number("mass_kg", weight);
  file.number("lever_mm", lever);
  file.number("tilt_deg", tilt);
  if (!dice.happens(0.4)) return;
  file.table("spring");
  file.number("stiffness_Nmm_per_rad", std::abs(mean) * dice.between(0, 0.6));
  file.number("preload_Nmm", std::abs(mean) * dice.between(0, 0.6));
  file.number("free_deg", dice.between(-90, 0));
}

std::string wide_design(std::uint64_t seed) {
  Dice dice(seed);
  WideText file{"schema = 1\nname = \"wide\"\n"};
  add_joint(dice, file);
  add_guides(dice, file);
  // The pulley turns by less than one turn.
  const double ratio = std::min(dice.between(0.7, 3.5), 330 / (file.high - file.low));
  const double pulley = file.size / ratio;
  if (dice.happens(0.25)) add_sheath(dice, file, pulley);
  file.table("pulley");
  file.number("EF_mm", std::max(2.5 * pulley, file.size * dice.between(2, 6)));
  const double law = dice.between(0, 1);
  if (law < 0.4) {
    file.word("law", "linear");
    file.number("ratio", ratio);
  } else if (law < 0.8) {
    file.number("r1_mm", pulley);
  } else {
    file.word("law", "torque");
    add_torque_law(dice, file, ratio);
  }
  if (law < 0.8 && dice.happens(0.5)) {
    file.table("load");
    file.number("torque_Nmm", dice.between(-1, 1) * dice.log_between(10, 40000));
  }
  if (dice.happens(0.3)) {
    file.table("body");
    file.number("bore_diameter_mm", dice.between(2, 8));
    if (dice.happens(0.5)) file.word("groove", dice.happens(0.5) ? "u" : "v");
  }
  return file.text;
}

/// Limit of the rewinding error, deg: 0.005 for joints with tendon arms of 8 mm or more, and the same length of tendon
/// for smaller ones.
double rewinding_limit(const profile::SynthesisResult& synthesis) {
  double arm = 1e9;
  for (const transmission::TransmissionPoint& at : synthesis.stroke) arm = std::min({arm, at.t1.m, at.t2.m});
  return 0.005 * std::max(1.0, 8.0 / arm);
}

/// The kit's printed parts (plates to drill and the drum) are sound solids, or the obstacle is reported.
void expect_plates_or_reasons(const formats::Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const kit::KitPlan plan = kit::plan_kit(mechanism, product.synthesis, product.pulley.layout);
  EXPECT_EQ(plan.made(), profile::failed_of(plan.conditions).empty());
  EXPECT_EQ(plan.made(), !plan.parts.empty());
  for (const kit::KitPart& part : plan.parts) {
    if (part.places.empty()) continue;
    for (const Check& check : solid::check_mesh(kit::printed_mesh(part, mechanism, product.pulley.layout)))
      EXPECT_TRUE(check.ok) << part.name << " " << check.name << " " << check.value;
  }
}

/// Builds joint `number` of a campaign.
BuildEnd build_wide_joint(const std::string& text, int number) {
  pipeline::BuildOptions options;
  options.dry_run = true;
  options.advice = std::getenv("FUSEE_LONG_TESTS") != nullptr;
  try {
    MechanismFile file;
    file.mechanism = fusee::testing::with_motor_and_units(text, static_cast<std::uint64_t>(number), "wide.toml");
    const pipeline::BuildResult built = pipeline::build(file, options);
    for (const Check& check : built.product.checks)
      EXPECT_TRUE(check.ok) << check.name << " " << check.value << ", limit " << check.limit << "; " << check.where;
    if (built.status == pipeline::BuildStatus::infeasible) return BuildEnd::refused;
    const profile::RewindResult& wound = built.product.as_built;
    // Multi-turn pulleys are tested in random_turns_test.cpp.
    if (!built.product.helix) {
      EXPECT_LT(degrees(wound.max_theta_error), rewinding_limit(built.product.synthesis))
          << "at alpha " << degrees(wound.max_theta_error_at);
    }
    if (!built.product.helix) expect_plates_or_reasons(built.product);
    return BuildEnd::made;
  } catch (const InputError&) {
    return BuildEnd::bad_input;
  }
}

constexpr int k_wide_shards = 4;  // so that ctest can run them in parallel

class WideCampaign : public ::testing::TestWithParam<int> {};

TEST_P(WideCampaign, JointsAreBuiltOrRefused) {
  const int cases = number_in("FUSEE_LAW_CASES", 24), seed = number_in("FUSEE_LAW_SEED", 1);
  int made = 0, refused = 0, bad = 0;
  for (int i = GetParam(); i < cases; i += k_wide_shards) {
    const std::string text = wide_design(static_cast<std::uint64_t>(seed) * 1000003 + static_cast<std::uint64_t>(i));
    SCOPED_TRACE(fmt::format("FUSEE_LAW_SEED={}, joint {}\n{}", seed, i, text));
    try {
      const BuildEnd end = build_wide_joint(text, i);
      if (end == BuildEnd::made) ++made;
      if (end == BuildEnd::refused) ++refused;
      if (end == BuildEnd::bad_input) ++bad;
    } catch (const std::exception& bug) {
      ADD_FAILURE() << bug.what();
    }
  }
  if (cases < 64) return;
  EXPECT_GT(made, cases / k_wide_shards / 10);
  EXPECT_GT(refused, 0);
  EXPECT_GT(made + refused, 8 * bad);
  std::printf("%d made, %d refused, %d bad input\n", made, refused, bad);
}

INSTANTIATE_TEST_SUITE_P(Random, WideCampaign, ::testing::Range(0, k_wide_shards));

}  // namespace
