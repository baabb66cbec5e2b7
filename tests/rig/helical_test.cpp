// Helical grooves: strings rise from the pin, or from their end, to the groove.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "rig/bench.h"
#include "rig/rig.h"

namespace fusee::rig {
namespace {

DeclaredMechanism wrist_turns() {
  DeclaredMechanism declared = read_mechanism(FUSEE_SOURCE_DIR "/profiles/wrist_turns.toml").mechanism;
  declared.load = {};
  return declared;
}

/// Rigid tendons and frictionless pins.
DeclaredMechanism stiff(DeclaredMechanism declared) {
  declared.tendon.modulus = 1e9;
  declared.guides.mu = 0;
  return declared;
}

double furthest_off(const DeclaredMechanism& declared) {
  const MadeJoint joint = make_joint(declared);
  EXPECT_TRUE(joint.is_helical());
  double off = 0;
  for (const double end : {joint.alpha_min, joint.alpha_max}) {
    Bench bench(joint, {});
    for (int i = 1; i <= 200; ++i) {
      const double alpha = end * i / 200;
      off = std::max(off, std::abs(bench.to(alpha, alpha, {}) - alpha / declared.pulley.ratio));
    }
  }
  return degrees(off);
}

// Curves of `build` come from unrolled paths; here strings are laid on them in space.
TEST(HelicalJoint, FollowsTargetMotion) { EXPECT_LT(furthest_off(stiff(wrist_turns())), 5e-4); }

TEST(HelicalJoint, FollowsTargetMotionWithCollars) {
  DeclaredMechanism declared = stiff(wrist_turns());
  declared.guides.collar = true;
  EXPECT_LT(furthest_off(declared), 5e-4);
}

// A rig without spare turns would tie the tendons as on a pulley of one turn.
TEST(HelicalJoint, TiesTendonsBehindSpareTurns) {
  const MadeJoint joint = make_joint(wrist_turns());
  const Bench bench(joint, {});
  for (const std::size_t side : {0u, 1u}) {
    const BenchTendon& tendon = bench.tendon(side);
    // Half of the range's three turns and a spare one, of a radius of 10 mm: some 150 mm.
    EXPECT_GT(tendon.laid.length(), 120.0);
    EXPECT_NEAR(tendon.laid.length(), tendon.wound, 1e-9);
  }
}

}  // namespace
}  // namespace fusee::rig
