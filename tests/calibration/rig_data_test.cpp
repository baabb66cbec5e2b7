// Six joints measured on a rig that shares no code with the fit, and a real one. With default options, calibration
// finds the true cause of each.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "fusee/base.h"
#include "fusee/calibration.h"
#include "fusee/mechanism_file.h"

namespace fusee::calibration {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

std::vector<std::filesystem::path> runs_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Calibration rig(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/data/rig" / name;
  return calibrate(read_mechanism(folder / "spec.toml").mechanism, measurement::read_measurement(runs_in(folder)));
}

std::vector<std::string> names(const Calibration& calibration) {
  std::vector<std::string> all;
  for (const FoundEffect& effect : calibration.effects) all.push_back(effect.name);
  return all;
}

TEST(RigData, DeclaredJointHasNoFalsePositive) {
  const Calibration found = rig("a_declared_right");
  EXPECT_EQ(found.verdict, CalibrationVerdict::no_effect);
  EXPECT_TRUE(found.effects.empty());
  EXPECT_LT(degrees(found.before.rms), 0.022);  // the sensor's noise is 0.02°
  EXPECT_FALSE(found.detectable.empty());
}

TEST(RigData, IdentifiesStiffnessOfSoftTendon) {
  const Calibration found = rig("b_stretch");
  EXPECT_EQ(found.verdict, CalibrationVerdict::explained);
  ASSERT_THAT(names(found), ElementsAre("tendon_stretch"));
  EXPECT_THAT(found.effects[0].group, ElementsAre("tendon_stretch"));
  const double truth = 9000.0 * 0.25 * k_pi * 0.8 * 0.8;
  EXPECT_NEAR(found.effects[0].parameters[0].value, truth, 0.02 * truth);
  EXPECT_LE(found.effects[0].parameters[0].low, truth);
  EXPECT_GE(found.effects[0].parameters[0].high, truth);
}

TEST(RigData, IdentifiesWidthOfBacklash) {
  const Calibration found = rig("c_backlash");
  EXPECT_EQ(found.verdict, CalibrationVerdict::explained);
  ASSERT_THAT(names(found), ElementsAre("backlash"));
  EXPECT_THAT(found.effects[0].group, ElementsAre("backlash"));
  EXPECT_NEAR(found.effects[0].parameters[0].value, 2.4, 0.05);
  EXPECT_LT(found.after.held_out_rms, 0.1 * found.before.held_out_rms);
}

TEST(RigData, GroupContainsThickerPin) {
  const Calibration found = rig("d_guide_radius");
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_THAT(found.effects[0].group, Contains("guide_radius"));
}

TEST(RigData, OneSweepLeavesCauseAmbiguous) {
  const Calibration found = rig("e_one_sweep_only");
  EXPECT_EQ(found.verdict, CalibrationVerdict::confounded);
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_GT(found.effects[0].group.size(), 1u);
  EXPECT_TRUE(testing::Matches(Contains("pulley_scale"))(found.effects[0].group) ||
              testing::Matches(Contains("radius_offset"))(found.effects[0].group));
  EXPECT_FALSE(found.next.empty());
}

TEST(RigData, CauseOutsideCatalogueIsUnexplained) {
  const Calibration found = rig("f_not_in_any_catalogue");
  EXPECT_EQ(found.verdict, CalibrationVerdict::unexplained);
  EXPECT_TRUE(found.effects.empty()) << found.summary;
  EXPECT_GT(degrees(found.unexplained_rms), 0.05);
  EXPECT_FALSE(found.unexplained_where.empty());
}

// Data of O'Neill et al., RA-L 3(4), 2018, doi 10.1109/LRA.2018.2849862.
TEST(RealJaw, IdentifiesFrictionAndStretchWithoutDelay) {
  const char* folder = std::getenv("FUSEE_DAVINCI_JAW");
  if (folder == nullptr) GTEST_SKIP() << "FUSEE_DAVINCI_JAW is not set";
  const DeclaredMechanism declared = parse_mechanism(
      "schema = 1\nname = \"jaw\"\n[transmission]\nkind = \"ratio\"\nratio = -1.0928961748633879\n", "jaw.toml");
  measurement::MeasurementOptions options;
  options.columns = {{"load", "tau_out_Nm"}};
  const measurement::Measurement measurement = measurement::read_measurement(runs_in(folder), options);
  // As in the paper, the runs at 0.3 and 0.5 Hz are for validation only. If whole load levels are left out in turn, the
  // error is larger: 0.345°.
  CalibrationOptions speeds;
  for (const auto& run : measurement.runs) {
    if (run.name.find("_f2_") != std::string::npos || run.name.find("_f4_") != std::string::npos)
      speeds.hold_out.push_back(run.name);
  }
  ASSERT_EQ(speeds.hold_out.size(), 8u);
  const Calibration found = calibrate(declared, measurement, speeds);
  // Its hysteresis shrinks as the load grows, 3.5, 2.1, 1.75, 1.6 degrees: friction in a cable that stiffens.
  EXPECT_THAT(names(found), Contains("capstan_friction"));
  EXPECT_THAT(names(found), Contains("tendon_stretch"));
  EXPECT_THAT(names(found), Not(Contains("sensor_lag")));
  EXPECT_EQ(found.verdict, CalibrationVerdict::unexplained);
  EXPECT_GT(degrees(found.before.held_out_rms), 1.5);
  // Error of the validation runs. The MAP estimate leaves 0.377°.
  EXPECT_LE(degrees(found.after.held_out_rms), 0.33);
}

}  // namespace
}  // namespace fusee::calibration
