// Logs of a joint with a cable that is a wavy chain of springs with dry contacts. Calibration identifies its causes.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "fusee/base.h"
#include "fusee/calibration.h"
#include "fusee/mechanism_file.h"
#include "support/rubbed_chain.h"

namespace fusee::calibration {
namespace {

struct HiddenCable {
  double per_N = 0.4;     ///< compliance, deg
  double turned = 0.3;    ///< μφ of the whole path
  double unloaded = 0.8;  ///< friction of the whole path from pretension, N
  double waves = 0;       ///< deg
  double waves_rate = 0;  ///< per N
  double bump = 0;        ///< error of a place in the middle of the range, deg
  double linkage = 0;     ///< of a slotted lever behind the cable: offset of its pivot / its length
};

constexpr double k_ratio = 2, k_noise = 0.02;

/// A lever of length 1 turned by `u` moves a slot whose pivot stands `offset` beyond its own. deg
double through_slot(double u, double offset) {
  const double turned = u * k_pi / 180;
  return std::atan2(std::sin(turned), std::cos(turned) + offset) * 180 / k_pi * (1 + offset);
}

/// Three cycles of ±60° of α under one load, five rows per second.
std::filesystem::path written(const HiddenCable& hidden, double load, std::mt19937& random) {
  const std::string name = "cable_" + std::to_string(hidden.waves) + "_" + std::to_string(hidden.linkage) + "_" +
                           std::to_string(hidden.bump) + "_" + std::to_string(load) + ".csv";
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / name;
  std::ofstream file(path);
  file << "time_s,alpha_deg,theta_deg,load_N\n";
  testing::RubbedChain chain(hidden.turned, hidden.per_N * hidden.unloaded);
  std::normal_distribution<double> noise(0, k_noise);
  for (int i = 0; i <= 40; ++i) chain.to(0, hidden.per_N * load * i / 40);
  constexpr int rows = 300;
  for (int i = 0; i < rows; ++i) {
    const double alpha = 60 * std::sin(2 * k_pi * 3 * i / rows), x = hidden.waves_rate * load;
    const double cable = chain.to(alpha / k_ratio, hidden.per_N * load) - hidden.waves * x / (1 + x);
    const double theta = through_slot(cable, hidden.linkage) + hidden.bump * std::exp(-std::pow(alpha / 15, 2));
    file << i / 5.0 << ',' << alpha << ',' << theta + noise(random) << ',' << load << '\n';
  }
  return path;
}

Calibration calibrated(const HiddenCable& hidden) {
  std::mt19937 random(1);
  std::vector<std::filesystem::path> runs;
  for (const double load : {1.0, 3.0, 6.0, 10.0}) runs.push_back(written(hidden, load, random));
  const DeclaredMechanism declared =
      parse_mechanism("schema = 1\nname = \"cable\"\n[transmission]\nkind = \"ratio\"\nratio = 2\n", "cable.toml");
  CalibrationOptions options;
  options.audit = false;
  return calibrate(declared, measurement::read_measurement(runs), options);
}

const FoundEffect* effect(const Calibration& calibration, const std::string& name) {
  const auto found = std::find_if(calibration.effects.begin(), calibration.effects.end(),
                                  [&](const FoundEffect& one) { return one.name == name; });
  return found == calibration.effects.end() ? nullptr : &*found;
}

TEST(CableData, IdentifiesStretchFrictionAndStiffening) {
  HiddenCable hidden;
  hidden.waves = 1.5;
  hidden.waves_rate = 0.5;
  const Calibration found = calibrated(hidden);
  const FoundEffect* stretch = effect(found, "tendon_stretch");
  ASSERT_NE(stretch, nullptr) << found.summary;
  EXPECT_THAT(stretch->group, ::testing::Contains("tendon_stiffening"));
  const FoundEffect* friction = effect(found, "capstan_friction");
  ASSERT_NE(friction, nullptr) << found.summary;
  EXPECT_NEAR(friction->parameters[0].value, 0.15, 0.05);
  EXPECT_LT(found.after.held_out_rms, 0.05 * found.before.held_out_rms);
}

TEST(CableData, CoversCurvedLinkageWithoutReportingEffect) {
  HiddenCable hidden;
  hidden.linkage = 0.6;
  const Calibration found = calibrated(hidden);
  EXPECT_EQ(effect(found, "ratio_curve"), nullptr);
  EXPECT_NE(found.identified.ratio_joint.curve.cube, 0) << found.summary;
  EXPECT_LT(found.after.held_out_rms, 0.05 * found.before.held_out_rms) << found.summary;
}

TEST(CableData, EmpiricalCurveCoversErrorOfPlace) {
  HiddenCable hidden;
  hidden.linkage = 0.6;
  hidden.bump = 0.5;
  const Calibration found = calibrated(hidden);
  EXPECT_TRUE(found.curve.used) << found.curve.why << found.summary;
  EXPECT_LT(found.after.held_out_rms, 0.6 * found.after_effects.held_out_rms);
  EXPECT_LT(found.after.rms, 0.6 * found.after_effects.rms);
}

}  // namespace
}  // namespace fusee::calibration
