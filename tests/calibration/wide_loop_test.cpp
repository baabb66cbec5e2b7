// The whole loop on joints with a drum, attachments of their own and idlers: measured, calibrated, given the corrected
// pulley, and measured again with the same fault, by a rig that shares no equation with what made it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "calibration/whole_loop.h"
#include "fusee/mechanism_file.h"

namespace fusee::rig {
namespace {

struct WideLoop {
  const char* profile;
  const char* effect;
  double load;  ///< N, at the tip
};

class WideWholeLoop : public testing::TestWithParam<WideLoop> {};

TEST_P(WideWholeLoop, PulleyCorrectsFault) {
  const auto [profile, effect, load] = GetParam();
  const std::string file = std::string(FUSEE_SOURCE_DIR) + "/profiles/" + profile + ".toml";
  DeclaredMechanism declared = read_mechanism(file).mechanism;
  declared.load = {};  // a compliant joint misses its law without a fault
  const MadeJoint joint = make_joint(declared);
  int turned = 0;
  for (const LoopCase& one : loop_cases(declared, load)) {
    if (one.name != effect) continue;
    const auto folder = std::filesystem::path(testing::TempDir()) / ("fusee_wide_" + std::string(profile));
    const LoopOutcome outcome = turn_loop(joint, write_mechanism(declared), one, folder);
    EXPECT_GT(outcome.before, 5 * outcome.declared);
    EXPECT_LT(outcome.after, 0.03 * outcome.before + outcome.declared) << outcome.found;
    ++turned;
  }
  EXPECT_EQ(turned, 1);
}

INSTANTIATE_TEST_SUITE_P(Joint, WideWholeLoop,
                         testing::Values(WideLoop{"finger_mcp", "drum_runout", 0.5},
                                         WideLoop{"ankle_exo", "attachment2_place", 15},
                                         WideLoop{"elbow_idlers", "drum_radius", 1.5}),
                         [](const auto& each) { return std::string(each.param.profile) + "_" + each.param.effect; });

}  // namespace
}  // namespace fusee::rig
